// core/punctura/scene: the keys of a scene file, and scenes by the paths of their fields.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <tuple>

#include "bindings.hpp"
#include "punctura/scene/by_path.hpp"

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
      throw nb::value_error(("the scene has no number " + path).c_str());
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

}  // namespace

void bind_scene_keys(nb::module_& m) {
  auto key =
      nb::class_<SceneKey>(m, "SceneKey", "A key of a scene file, from the core's tables. Bounds are in SI units.");
  def_repr(key, "<SceneKey {0.key} of [{0.table}]>");
  key.def_prop_ro(
         "table", [](const SceneKey& k) { return std::string(k.table); }, "The table that has it; \"\" is the file")
      .def_ro("key", &SceneKey::key)
      .def_ro("name", &SceneKey::name, "In the core; a column has [] in place of the row: \"profile[].depth\"")
      .def_prop_ro(
          "kind", [](const SceneKey& k) { return std::string(word_of(k.kind)); },
          "number, number_or_word, vector, column, word, text or gauge")
      .def_prop_ro("title", [](const SceneKey& k) { return title_of(k.field); })
      .def_prop_ro("help", [](const SceneKey& k) { return std::string(k.field.help); })
      .def_prop_ro(
          "symbol", [](const SceneKey& k) { return std::string(k.field.symbol); }, "K06's")
      .def_prop_ro("min", [](const SceneKey& k) { return k.field.range.min; })
      .def_prop_ro("max", [](const SceneKey& k) { return k.field.range.max; })
      .def_prop_ro(
          "min_open", [](const SceneKey& k) { return k.field.range.min_open; }, "Whether it must be greater than min")
      .def_prop_ro(
          "max_open", [](const SceneKey& k) { return k.field.range.max_open; }, "Whether it must be less than max")
      .def_prop_ro(
          "reason", [](const SceneKey& k) { return k.field.range.reason; }, "The reason for the bounds")
      .def_prop_ro(
          "words", [](const SceneKey& k) { return std::vector<std::string>(k.words.begin(), k.words.end()); },
          "Of a word; else empty")
      .def_prop_ro("default", &default_of, nb::sig("def default(self) -> float | str | tuple[()] | None"),
                   "In SI; None if the file must have the key")
      .def_prop_ro("required", &SceneKey::required)
      .def_prop_ro(
          "group", [](const SceneKey& k) { return std::string(k.group); },
          "The part of a form that has it and is closed at first, or \"\"")
      .def_prop_ro(
          "instead_of", [](const SceneKey& k) { return std::string(k.instead_of); },
          "The field for which a file has this key or the other; else empty")
      .def_ro("sparse", &SceneKey::sparse, "Whether a file has it only where it differs from its default");

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
