// The scene of the C ABI: structs, values by path, and words.
#include "scene.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "punctura/scene/usual.hpp"
#include "punctura/scene/values.hpp"
#include "structs.hpp"

namespace punctura::c {

Scene empty_scene() {
  Scene scene;
  scene.needle = {not_given, not_given};
  scene.coupling = {not_given, not_given};
  return scene;
}

PlacedMembrane empty_membrane() {
  PlacedMembrane placed;
  placed.membrane = {not_given, not_given, not_given, not_given};
  placed.point = placed.inward_normal = {not_given, not_given, not_given};
  return placed;
}

SyringeSettings empty_syringe() {
  SyringeSettings settings;
  for (const auto& field : syringe_fields) settings.syringe.*field.member = not_given;
  settings.syringe.air = 0;
  return settings;
}

namespace {

template <typename Enum, std::size_t n>
bool take(Enum& to, const std::string& path, std::string_view word, const std::array<std::string_view, n>& words,
          std::vector<Problem>& problems) {
  if (const auto found = enum_of<Enum>(word, words)) {
    to = *found;
    return true;
  }
  std::string reason = "\"" + std::string(word) + "\" is unknown; it must be one of";
  for (const auto known : words) reason += (known == words.front() ? " \"" : ", \"") + std::string(known) + "\"";
  problems.push_back({path, not_given, reason});
  return false;
}

// In the order of the enumerators
constexpr std::array<std::string_view, 2> direction_words = {"stylus", "motion"};
constexpr std::array<std::string_view, 2> solver_words = {"paper", "exact"};
constexpr std::array<std::string_view, 2> conditioning_words = {"low_pass", "line_fit"};

/// The membrane of a path "membrane[i].rest", and the rest.
PlacedMembrane* membrane_of(Scene& scene, std::string_view path, std::string_view& rest) {
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const std::string head = "membrane[" + std::to_string(i) + "].";
    if (path.substr(0, head.size()) != head) continue;
    rest = path.substr(head.size());
    return &scene.membranes[i];
  }
  return nullptr;
}

/// The number at a path; nullptr if there is none.
template <typename SceneT>
auto* number_at(SceneT& scene, std::string_view path) {
  std::remove_reference_t<decltype((scene.needle.diameter))>* found = nullptr;
  for_each_value(scene, [&](const std::string& name, const Field&, auto& number) {
    if (name == path) found = &number;
  });
  return found;
}

punctura_status no_path(const char* path) {
  return fail(PUNCTURA_BAD_ARGUMENT,
              "the scene has no number \"" + std::string(path) + "\"; punctura_scene_field() lists all of them");
}

}  // namespace

bool set_word(Scene& scene, const std::string& path, std::string_view word, std::vector<Problem>& problems) {
  if (!check_name(word, path, problems)) return false;
  if (path == "name") return scene.name = word, true;
  if (path == "needle.direction") return take(scene.direction, path, word, direction_words, problems);
  if (path == "servo.solver") return take(scene.servo.solver, path, word, solver_words, problems);
  if (path == "servo.conditioning") return take(scene.servo.conditioning, path, word, conditioning_words, problems);
  if (path == "display.force_scale" && word == "automatic") return scene.display.automatic = true;
  std::string_view rest;
  if (PlacedMembrane* membrane = membrane_of(scene, path, rest)) {
    if (rest == "name") return membrane->name = word, true;
    if (rest == "look") return take(membrane->look, path, word, look_words, problems);
    if (rest == "behind") return take(membrane->behind, path, word, behind_words, problems);
    if (rest == "grip") return take(membrane->tissue.grip, path, word, punctura::grip_words, problems);
  }
  problems.push_back({path, not_given, "there is no such word in the scene"});
  return false;
}

bool make_rows(Scene& scene, const std::string& list, std::size_t count) {
  const auto grow = [&](auto& rows, const auto& row) {
    if (rows.size() < count) rows.resize(count, row);
    return true;
  };
  if (list == "coupling.relaxation") return grow(scene.relaxation, MaxwellBranch{not_given, not_given});
  std::string_view rest;
  PlacedMembrane* membrane = membrane_of(scene, list, rest);
  if (membrane && rest == "grip_table") return grow(membrane->tissue.grip_table, GripPoint{not_given, not_given});
  if (membrane && rest == "profile") return grow(membrane->tissue.profile, Knot{not_given, not_given, not_given});
  return false;
}

}  // namespace punctura::c

using namespace punctura::c;
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
  return guarded([&] {
    if (!setup || !scene) return null_pointer();
    if (!known_size(setup))
      return fail(PUNCTURA_BAD_ARGUMENT, "setup.struct_size is wrong: call punctura_setup_init()");
    auto made = std::make_unique<punctura_scene>(punctura_scene{empty_scene()});
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
  return guarded([&] {
    if (!scene || !membrane) return null_pointer();
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
  return guarded([&] {
    if (!scene) return null_pointer();
    scene->scene.syringe = empty_syringe();
    return ok;
  });
}

punctura_status punctura_scene_make_rows(punctura_scene* scene, const char* list, size_t count) {
  return guarded([&] {
    if (!scene || !list) return null_pointer();
    if (count > longest_list || !make_rows(scene->scene, list, count))
      return fail(PUNCTURA_BAD_ARGUMENT, "the scene has no list \"" + std::string(list) + "\" that can have " +
                                             std::to_string(count) + " rows");
    return ok;
  });
}

punctura_status punctura_scene_copy(const punctura_scene* scene, punctura_scene** copy) {
  return guarded([&] {
    if (!scene || !copy) return null_pointer();
    *copy = std::make_unique<punctura_scene>(*scene).release();
    return ok;
  });
}

void punctura_scene_free(punctura_scene* scene) { delete scene; }

punctura_status punctura_scene_set(punctura_scene* scene, const char* path, double value) {
  return guarded([&] {
    if (!scene || !path) return null_pointer();
    double* number = number_at(scene->scene, path);
    if (!number && std::string_view(path) == "display.force_scale") {  // a number instead of "automatic"
      scene->scene.display.automatic = false;
      number = &scene->scene.display.force_scale;
    }
    if (!number) return no_path(path);
    *number = value;
    return ok;
  });
}

punctura_status punctura_scene_get(const punctura_scene* scene, const char* path, double* value) {
  return guarded([&] {
    if (!scene || !path || !value) return null_pointer();
    const double* number = number_at(scene->scene, path);
    if (!number) return no_path(path);
    *value = *number;
    return ok;
  });
}

punctura_status punctura_scene_set_word(punctura_scene* scene, const char* path, const char* word) {
  return guarded([&] {
    if (!scene || !path || !word) return null_pointer();
    std::vector<punctura::Problem> problems;
    if (set_word(scene->scene, path, word, problems)) return ok;
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
  return guarded([&] {
    if (!scene || !field) return null_pointer();
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
  return guarded([&] {
    if (!scene) return null_pointer();
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
