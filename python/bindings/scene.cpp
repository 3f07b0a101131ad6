// core/punctura/scene: the parameters of a run, and their checks.
#include "punctura/scene/scene.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/variant.h>

#include <map>

#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "punctura/scene/keys.hpp"
#include "punctura/scene/usual.hpp"
#include "punctura/scene/values.hpp"
#include "struct.hpp"

namespace punctura::bindings {
enum class Automatic { automatic };
}
template <>
inline constexpr std::array<std::string_view, 1> punctura::words_of<punctura::bindings::Automatic>{
    punctura::automatic_word};

namespace punctura::bindings {
namespace {

using ScaleOrWord = std::variant<double, Word<Automatic>>;

DisplaySettings make_display(const ScaleOrWord& force_scale) {
  DisplaySettings made;
  if (const auto* number = std::get_if<double>(&force_scale))
    made.force_scale = *number;
  else if (std::get<Word<Automatic>>(force_scale).text == automatic_word)
    made.automatic = true;
  else
    raise_word("display.force_scale", std::get<Word<Automatic>>(force_scale).text, "must be a number or \"automatic\"");
  std::vector<Problem> problems;
  check_fields(display_fields, made, "display", problems);
  raise_if(problems);
  return made;
}

/// A number of one scene, with its bounds.
struct SceneField {
  std::string path;
  double value;
  std::string symbol, unit;
  double min, max;
  bool min_open, max_open;
  std::string reason;
};

constexpr std::tuple scene_field_rows{
    row("path", &SceneField::path, "Path, as in problems: membrane[0].friction."),
    row("value", &SceneField::value),
    row("symbol", &SceneField::symbol, "K06's."),
    row("unit", &SceneField::unit),
    row("min", &SceneField::min),
    row("max", &SceneField::max),
    row("min_open", &SceneField::min_open, "Whether the value must be greater than min."),
    row("max_open", &SceneField::max_open, "Whether the value must be less than max."),
    row("reason", &SceneField::reason, "The reason for the bounds."),
};

constexpr std::tuple syringe_settings_rows{
    row("syringe", &SyringeSettings::syringe),
    row("thumb", &SyringeSettings::thumb, "The virtual coupling between thumb and plunger."),
};

constexpr std::tuple scene_rows{
    scene_name_field,
    row("needle", &Scene::needle),
    row("coupling", &Scene::coupling),
    row("membranes", &Scene::membranes),
    row("servo", &Scene::servo),
    direction_field,
    row("display", &Scene::display),
    row("syringe", &Scene::syringe, "The syringe on the needle; None without one."),
    relaxation_field,
};

std::vector<SceneField> fields_of(const Scene& scene) {
  std::vector<SceneField> all;
  for_each_value(scene, [&](const std::string& path, const Field& field, double value) {
    const Range& range = field.range;
    all.push_back({path, value, std::string(field.symbol), std::string(field.unit), range.min, range.max,
                   range.min_open, range.max_open, bound_text(field)});
  });
  return all;
}

bool is_number(nb::handle given) {
  return !PyBool_Check(given.ptr()) && !nb::isinstance<nb::str>(given) && !PyComplex_Check(given.ptr()) &&
         PyNumber_Check(given.ptr());
}

/// False for a NumPy scalar of another kind, such as complex64 or str, from which NumPy makes a float all the same.
bool is_real(nb::handle given) {
  if (!nb::hasattr(given, "dtype")) return true;
  const auto kind = nb::cast<std::string>(nb::str(given.attr("dtype").attr("kind")));
  return kind == "f" || kind == "i" || kind == "u";
}

/// Throws TypeError or ValueError, which names the path and has the exception of __float__ as its cause.
double number_at(const std::string& path, nb::handle given) {
  if (!is_number(given)) throw type_error("with_values(): " + path + " must be a number; replace() sets words");
  const std::string no_number = "with_values(): " + path + " must be one real number";
  if (axes_of(given) > 0 || !is_real(given)) throw type_error(no_number);
  const double number = PyFloat_AsDouble(given.ptr());
  if (!PyErr_Occurred()) return number;
  nb::python_error error;
  const bool too_large = error.matches(PyExc_OverflowError);
  if (!too_large && !error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw error;
  const std::string says = too_large ? "with_values(): " + path + " is too large for a number" : no_number;
  nb::raise_from(error, too_large ? PyExc_ValueError : PyExc_TypeError, "%s", says.c_str());
}

Scene with_values(Scene scene, const nb::dict& values) {
  std::map<std::string, double*> places;
  for_each_value(scene, [&](const std::string& path, const Field&, double& number) { places[path] = &number; });
  std::vector<Problem> problems;
  for (nb::handle item : values.items()) {  // a copy, because __float__ could change the dict
    if (!nb::isinstance<nb::str>(item[0]))
      throw nb::type_error("with_values(): paths must be str: {\"membrane[0].friction\": 0.3}");
    const auto path =
        nb::cast<std::string>(item[0].attr("encode")("utf-8", "backslashreplace").attr("decode")("utf-8"));
    if (const auto place = places.find(path); place != places.end()) {
      *place->second = number_at(path, item[1]);
      warn_unusual(path, *place->second);
      continue;
    }
    nb::list paths;
    for (const auto& known : places) paths.append(known.first);
    const std::string says = "is not a number of this scene (scene.fields() lists them";
    if (!is_number(item[1])) throw type_error("with_values(): " + path + " " + says + "); replace() sets words");
    problems.push_back({path, number_at(path, item[1]), says + ")" + nearest(path, paths)});
  }
  for (const Problem& problem : check(scene)) problems.push_back(problem);
  raise_if(problems);
  return scene;
}

}  // namespace

void bind_scene(nb::module_& m) {
  m.attr("longest_name") = longest_name;
  def_struct<syringe_settings_rows>(m,
                                    {.name = "SyringeSettings",
                                     .doc = "The syringe on a scene's needle. docs/syringe.md",
                                     .raises = "The scene that uses it checks all values.",
                                     .needed = 1},
                                    unchecked);
  def_struct<servo_rows>(
      m, {"ServoSettings", "Rate of the servo loop, position conditioning and solver. K06 section 4", "servo"},
      [](const ServoSettings& made, std::vector<Problem>& problems) { check(made, problems); });

  auto display = nb::class_<DisplaySettings>(m, "DisplaySettings", "How a device shows forces that it cannot give.");
  const auto& field = display_fields[0];
  const std::string name(field.name), doc = doc_of(field), raises = name + ": " + doc + " Raises ConfigurationError.";
  display.def_prop_ro(
      name.c_str(),
      [](const DisplaySettings& d) {
        return d.automatic ? ScaleOrWord(Automatic::automatic) : ScaleOrWord(d.force_scale);
      },
      doc.c_str());
  def_init(display, &make_display, nb::arg(field.name.data()) = DisplaySettings{}.force_scale, raises.c_str());
  def_value(display, {field.name.data()});

  def_struct<scene_field_rows>(m,
                               {.name = "SceneField",
                                .doc = "A number of a scene: its path, its value and its bounds, in SI units.",
                                .raises = "Scene.fields() creates these objects.",
                                .needed = 9},
                               unchecked);
  def_struct<scene_rows>(m,
                         {.name = "Scene",
                          .doc = "All parameters of a run, checked together.",
                          .path = "needle",  // of the direction
                          .raises = "Raises ConfigurationError with all problems.",
                          .needed = 4},
                         [](const Scene& made, std::vector<Problem>& problems) { problems = check(made); })
      .def_prop_ro(
          "lumen", [](const Scene& s) { return lumen(s); },
          "Indices of the two membranes with blood between them; None if there is no blood")
      .def("fields", &fields_of, "All numbers of the scene, each with its path, unit and bounds.")
      .def("with_values", &with_values, nb::arg("values"),
           nb::sig("def with_values(self, values: dict[str, float]) -> Scene"),
           "A copy with changed numbers, by path, in SI units: {\"membrane[0].friction\": 0.3}. Raises\n"
           "ConfigurationError or TypeError.");

  m.def(
      "unusual_list",
      [](const std::string& column, const std::vector<double>& written, double size) {
        return unusual_list(column, written, size);
      },
      nb::arg("column"), nb::arg("written"), nb::arg("size") = 1.0,
      "The number of a list that is probably in another unit, and what to write instead; None if there is none.\n\n"
      "column: of scene_keys(), such as profile[].depth. size: of the unit of `written`, SI.");
  m.def(
      "unusual", [](const std::string& path, double written, double size) { return unusual(path, written, size); },
      nb::arg("path"), nb::arg("written"), nb::arg("size"),
      "What to write instead of a number that is off by a factor of 1,000; empty if it is not. written: in a unit of\n"
      "`size` in SI.");

  m.def("set_unusual_warnings", &set_unusual_warnings, nb::arg("on"),
        "Sets whether constructors warn in this thread of numbers in a probably wrong unit. Returns the value before.");
}

}  // namespace punctura::bindings
