// core/punctura/scene: the keys of a scene file, and scenes by the paths of their fields.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <tuple>

#include "bindings.hpp"
#include "punctura/scene/by_path.hpp"
#include "state.hpp"
#include "struct.hpp"

namespace punctura::bindings {
namespace {

using FoundProblem = std::tuple<std::string, double, std::string>;

/// The size of a unit in SI, for decimal.Decimal.
std::string size_of(const FileUnit& unit) { return std::string(unit.digits) + "e" + std::to_string(unit.exponent); }

nb::object default_of(const SceneKey& key) {
  if (key.kind == KeyKind::column) return nb::tuple();
  if (key.kind == KeyKind::word) return nb::str(key.word.data(), key.word.size());
  return key.required() ? nb::none() : nb::object(nb::float_(key.number));
}

/// Sets what a file has given: numbers, words and texts by their paths. The others have their defaults, or none.
std::tuple<std::optional<Scene>, std::vector<FoundProblem>> scene_from_values(const nb::dict& values,
                                                                              std::size_t membranes, bool syringe) {
  Scene scene;
  scene.membranes.resize(membranes);
  if (syringe) scene.syringe.emplace();
  std::vector<std::pair<std::string, nb::object>> given;
  for (const auto& [path, value] : values) given.emplace_back(nb::cast<std::string>(path), nb::borrow(value));
  for (const auto& [path, value] : given) make_room(scene, path, membranes);
  const ScenePlaces places(scene);
  std::vector<Problem> problems;
  for (const auto& [path, value] : given) {
    if (nb::isinstance<nb::str>(value))
      places.set(path, nb::cast<std::string>(value), problems);
    else if (double* const number = places.number(path))
      *number = nb::cast<double>(value);
    else
      throw value_error("the scene has no number " + path);
  }
  for (const Problem& problem : check(scene)) problems.push_back(problem);
  std::vector<FoundProblem> found;
  for (const Problem& p : problems) found.emplace_back(p.path, p.value, p.reason);
  return {found.empty() ? std::optional(scene) : std::nullopt, found};
}

nb::dict scene_values(const Scene& scene) {
  nb::dict values;
  const auto set = [&](const std::string& path, const nb::object& value) { values[path.c_str()] = value; };
  visit_scene(scene, [&](const std::string& path, const Field&, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double>) {
      set(path, nb::float_(value));
    } else if constexpr (std::is_enum_v<Value>) {
      set(path, nb::str(word_of(value).data(), word_of(value).size()));
    } else if constexpr (std::is_same_v<Value, std::string>) {
      set(path, nb::str(value.c_str(), value.size()));
    } else if constexpr (std::is_same_v<Value, std::array<double, 3>>) {
      set(path, nb::cast(value));
    } else {
      for (const auto& column : columns_of<typename Value::value_type>) {
        nb::list numbers;
        for (const auto& row : value) numbers.append(row.*column.member);
        set(path + "[]." + std::string(column.name), numbers);
      }
    }
  });
  if (scene.display.automatic) set("display.force_scale", nb::str(automatic_word.data(), automatic_word.size()));
  return values;
}

// What Python tells of a key, of its field, and of the field's range.
constexpr std::tuple key_rows{
    row("table", &SceneKey::table, "The table that has it; \"\" is the file."),
    row("key", &SceneKey::key),
    row("name", &SceneKey::name, "In the core; a column has [] in place of the row: \"profile[].depth\"."),
    row("kind", &SceneKey::kind),
    row("words", &SceneKey::words, "Of a word; else empty."),
    row("group", &SceneKey::group, "The part of a form that has it and is closed at first, or \"\"."),
    row("instead_of", &SceneKey::instead_of, "The field for which a file has this key or the other; else empty."),
    row("sparse", &SceneKey::sparse, "Whether a file has it only where it differs from its default."),
};
constexpr std::tuple field_rows{row("help", &Field::help), row("symbol", &Field::symbol, "K06's.")};
constexpr std::tuple range_rows{
    row("min", &Range::min),
    row("max", &Range::max),
    row("min_open", &Range::min_open, "Whether it must be greater than min."),
    row("max_open", &Range::max_open, "Whether it must be less than max."),
};

}  // namespace

void bind_scene_keys(nb::module_& m) {
  auto key =
      nb::class_<SceneKey>(m, "SceneKey", "A key of a scene file, from the core's tables. Bounds are in SI units.");
  def_repr(key, "<SceneKey {0.key} of [{0.table}]>");
  for_each_row(key_rows, [&](const auto& row) { def_member(key, row); });
  for_each_row(field_rows, [&](const auto& row) { def_member(key, row, &SceneKey::field); });
  for_each_row(range_rows,
               [&](const auto& row) { def_member(key, row, [](auto& k) -> const auto& { return k.field.range; }); });
  const Getters get{key};
  get("title", "", [](auto& k) { return title_of(k.field); });
  get("default", "In SI; None if the file must have the key", &default_of,
      nb::sig("def default(self) -> float | str | tuple[()] | None"));
  get("required", "", &SceneKey::required);
  get("reason", "The bounds as a sentence, with the reason for them.", [](auto& k) { return bound_text(k.field); });

  m.def("scene_keys", &scene_keys, "All keys of a scene file, in the order of the file.");
  m.def(
      "scene_tables",
      [] {
        std::vector<std::tuple<std::string, std::string, std::string, bool>> all;
        for (const SceneTable& t : scene_tables) all.emplace_back(t.name, t.title, t.help, t.required);
        return all;
      },
      "Name, title and help of each table of a scene file, and whether a file needs it; the first is the file.");
  m.def(
      "file_units",
      [] {
        std::vector<std::tuple<std::string, std::string, std::string>> all;
        for (const FileUnit& unit : file_units) all.emplace_back(unit.suffix, unit.name, size_of(unit));
        return all;
      },
      "The units of files: the end of a key, the name, and the size in SI as a decimal number.");
  m.def(
      "gauge_diameters",
      [] {
        nb::dict all;
        for (const GaugeDiameter& row : gauge_diameters) all[nb::int_(row.gauge)] = row.diameter;
        return all;
      },
      nb::sig("def gauge_diameters() -> dict[int, float]"), "Outer diameter of each gauge, m. ISO 9626:2016, Table 1");
  m.def("scene_from_values", &scene_from_values, nb::arg("values"), nb::arg("membranes"), nb::arg("syringe"),
        nb::sig("def scene_from_values(values: dict[str, float | str], membranes: int, syringe: bool) -> "
                "tuple[Scene | None, list[tuple[str, float, str]]]"),
        "A scene with these numbers (SI) and words by path; what is left out has its default. Returns None and all\n"
        "problems (path, value in SI, reason) if it is not valid.");
  m.def("scene_values", &scene_values, nb::arg("scene"),
        nb::sig("def scene_values(scene: Scene) -> dict[str, float | str | list[float]]"),
        "All numbers (SI), words and vectors of a scene by path; columns of lists as \"membrane[0].profile[].depth\".");
}

}  // namespace punctura::bindings
