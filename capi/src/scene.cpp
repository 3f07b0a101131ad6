// The scene of the C ABI: structs, values by path, and words.
#include "common.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "punctura/scene/by_path.hpp"
#include "punctura/scene/usual.hpp"

namespace punctura::c {

namespace {

/// The number at a path; nullptr if there is none.
template <typename SceneT>
auto* number_at(SceneT& scene, std::string_view path) {
  std::remove_reference_t<decltype((scene.needle.diameter))>* found = nullptr;
  for_each_value(scene, [&](const std::string& name, const Field&, auto& number) {
    if (name == path) found = &number;
  });
  return found;
}

punctura_status no_path(Scene scene, const char* path) {
  const bool has_syringe = scene.syringe.has_value();
  if (!has_syringe) scene.syringe.emplace();
  const ScenePlaces places(scene);
  const std::string hint = did_you_mean(path, places.numbers());
  return fail(PUNCTURA_BAD_ARGUMENT,
              "the scene has no number \"" + std::string(path) + "\"" +
                  (!has_syringe && places.number(path) ? ": add the syringe first, with punctura_scene_add_syringe()"
                                                       : hint + "; punctura_scene_field() lists all of them"));
}

}  // namespace

}  // namespace punctura::c

using namespace punctura::c;
using punctura::not_given;
using punctura::Scene;

punctura_status punctura_setup_init(punctura_setup* setup, size_t size) {
  const Scene d;
  return init(setup, size, {size, "", not_given, not_given, not_given, not_given, d.servo.rate, d.servo.low_pass});
}

punctura_status punctura_membrane_init(punctura_membrane* membrane, size_t size) {
  const double n = not_given;
  return init(membrane, size, {size, "", n, n, n, n, {n, n, n}, {n, n, n}});
}

punctura_status punctura_scene_new(const punctura_setup* setup, punctura_scene** scene) {
  return guarded({setup, scene}, [&] {
    if (!known_size(setup))
      return fail(PUNCTURA_BAD_ARGUMENT, "setup.struct_size is wrong: call punctura_setup_init()");
    auto made = std::make_unique<punctura_scene>(punctura_scene{});
    made->scene.name = setup->name ? setup->name : "";
    made->scene.needle = {setup->diameter, setup->tip_angle};
    made->scene.coupling = {setup->stiffness, setup->damping};
    made->scene.servo.rate = setup->rate;
    made->scene.servo.low_pass = setup->low_pass;
    *scene = made.release();
    return ok;
  });
}

punctura_status punctura_scene_add_membrane(punctura_scene* scene, const punctura_membrane* membrane) {
  return guarded({scene, membrane}, [&] {
    if (!known_size(membrane))
      return fail(PUNCTURA_BAD_ARGUMENT, "membrane.struct_size is wrong: call punctura_membrane_init()");
    punctura::PlacedMembrane placed;
    placed.name = membrane->name ? membrane->name : "";
    placed.membrane = {membrane->stiffness, membrane->precompression, membrane->friction, membrane->thickness};
    placed.point = std::to_array(membrane->point);
    placed.inward_normal = std::to_array(membrane->inward_normal);
    scene->scene.membranes.push_back(std::move(placed));
    return ok;
  });
}

punctura_status punctura_scene_add_syringe(punctura_scene* scene) {
  return guarded({scene}, [&] {
    scene->scene.syringe.emplace();
    return ok;
  });
}

punctura_status punctura_scene_make_rows(punctura_scene* scene, const char* list, size_t count) {
  return guarded({scene, list}, [&] {
    if (count > punctura::longest_list || !make_rows(scene->scene, list, count))
      return fail(PUNCTURA_BAD_ARGUMENT, "the scene has no list \"" + std::string(list) + "\" that can have " +
                                             std::to_string(count) + " rows");
    return ok;
  });
}

punctura_status punctura_scene_copy(const punctura_scene* scene, punctura_scene** copy) {
  return guarded({scene, copy}, [&] {
    *copy = std::make_unique<punctura_scene>(*scene).release();
    return ok;
  });
}

void punctura_scene_free(punctura_scene* scene) { delete scene; }

punctura_status punctura_scene_set(punctura_scene* scene, const char* path, double value) {
  return guarded({scene, path}, [&] {
    double* number = number_at(scene->scene, path);
    if (!number && std::string_view(path) == "display.force_scale") {  // a number instead of "automatic"
      scene->scene.display.automatic = false;
      number = &scene->scene.display.force_scale;
    }
    if (!number) return no_path(scene->scene, path);
    *number = value;
    return ok;
  });
}

punctura_status punctura_scene_get(const punctura_scene* scene, const char* path, double* value) {
  return guarded({scene, path, value}, [&] {
    const double* number = number_at(scene->scene, path);
    if (!number) return no_path(scene->scene, path);
    *value = *number;
    return ok;
  });
}

punctura_status punctura_scene_set_word(punctura_scene* scene, const char* path, const char* word) {
  return guarded({scene, path, word}, [&] {
    std::vector<punctura::Problem> problems;
    if (punctura::ScenePlaces(scene->scene).set(path, word, problems)) return ok;
    return fail(std::move(problems));
  });
}

int32_t punctura_scene_field_count(const punctura_scene* scene) {
  int32_t count = 0;
  if (scene)
    guarded([&] {
      for_each_value(scene->scene, [&](const std::string&, const punctura::Field&, double) { ++count; });
      return ok;
    });
  return count;
}

punctura_status punctura_scene_field(const punctura_scene* scene, int32_t index, punctura_field* field) {
  return guarded({scene, field}, [&] {
    if (!known_size(field)) return fail(PUNCTURA_BAD_ARGUMENT, "field.struct_size is wrong: set it to sizeof *field");
    int32_t count = 0;
    std::optional<punctura_field> found;
    for_each_value(scene->scene, [&](const std::string& path, const punctura::Field& f, double value) {
      if (count++ != index) return;
      found.emplace();
      const auto copy = [](auto& to, std::string_view from) {
        std::snprintf(to, sizeof to, "%.*s", static_cast<int>(from.size()), from.data());
      };
      copy(found->path, path);
      copy(found->symbol, f.symbol);
      copy(found->unit, f.unit);
      found->value = value;
      found->min = f.range.min;
      found->max = f.range.max;
      found->min_open = f.range.min_open;
      found->max_open = f.range.max_open;
    });
    if (!found)
      return fail(PUNCTURA_BAD_ARGUMENT, "field " + std::to_string(index) + ": the scene has " + std::to_string(count) +
                                             " fields, counted from 0");
    give(field, *found);
    return ok;
  });
}

int32_t punctura_scene_membrane_count(const punctura_scene* scene) {
  return scene ? static_cast<int32_t>(scene->scene.membranes.size()) : 0;
}

punctura_status punctura_scene_check(const punctura_scene* scene) {
  return guarded({scene}, [&] {
    auto problems = check(scene->scene);
    return problems.empty() ? ok : fail(std::move(problems));
  });
}

const char* punctura_scene_unusual(const punctura_scene* scene) {
  thread_local std::string text;
  text.clear();
  if (!scene) return "";
  guarded([&] {
    for (const std::string& line : punctura::unusual(scene->scene)) text += (text.empty() ? "" : "\n") + line;
    return ok;
  });
  return text.c_str();
}
