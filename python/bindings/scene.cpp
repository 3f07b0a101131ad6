// core/punctura/scene: the parameters of a run, and their checks.
#include "punctura/scene/scene.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/variant.h>

#include <map>

#include "arguments.hpp"
#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "punctura/scene/usual.hpp"
#include "punctura/scene/values.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

Direction direction_from(const std::string& name) {
  if (name == "stylus") return Direction::stylus;
  if (name == "motion") return Direction::motion;
  raise_word("needle.direction", name, "must be \"stylus\" or \"motion\"");
}

Conditioning conditioning_from(const std::string& name) {
  if (name == "low_pass") return Conditioning::low_pass;
  if (name == "line_fit") return Conditioning::line_fit;
  raise_word("servo.conditioning", name, "must be \"low_pass\" or \"line_fit\"");
}

const char* name_of(Conditioning c) { return c == Conditioning::line_fit ? "line_fit" : "low_pass"; }

ServoSettings unchecked_servo(double rate, double low_pass, std::string solver, std::string conditioning,
                              double encoder_step, double sub_steps) {
  return {rate,         low_pass, solver_from(solver, "servo.solver"), conditioning_from(conditioning),
          encoder_step, sub_steps};
}

ServoSettings make_servo(double rate, double low_pass, std::string solver, std::string conditioning,
                         double encoder_step, double sub_steps) {
  const auto made =
      unchecked_servo(rate, low_pass, std::move(solver), std::move(conditioning), encoder_step, sub_steps);
  std::vector<Problem> problems;
  check(made, problems);
  raise_if(problems);
  return made;
}

using ScaleOrWord = std::variant<double, std::string>;

DisplaySettings unchecked_display(const ScaleOrWord& force_scale) {
  if (const auto* number = std::get_if<double>(&force_scale)) return {*number, false};
  const auto& word = std::get<std::string>(force_scale);
  if (word != "automatic") raise_word("display.force_scale", word, "must be a number or \"automatic\"");
  return {DisplaySettings{}.force_scale, true};
}

DisplaySettings make_display(ScaleOrWord force_scale) {
  const DisplaySettings made = unchecked_display(force_scale);
  std::vector<Problem> problems;
  check_fields(display_fields, made, "display", problems);
  raise_if(problems);
  return made;
}

SyringeSettings make_settings(Syringe syringe, Coupling thumb) { return {syringe, thumb}; }

Scene make_scene(std::string name, Needle needle, Coupling coupling, std::vector<PlacedMembrane> membranes,
                 ServoSettings servo, std::string direction, DisplaySettings display,
                 std::optional<SyringeSettings> syringe, std::vector<MaxwellBranch> relaxation) {
  Scene made{std::move(name),           needle,  coupling, std::move(membranes), servo,
             direction_from(direction), display, syringe,  std::move(relaxation)};
  raise_if(check(made));
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

SceneField make_scene_field(std::string path, double value, std::string symbol, std::string unit, double min,
                            double max, bool min_open, bool max_open, std::string reason) {
  return {std::move(path), value, std::move(symbol), std::move(unit), min, max, min_open, max_open, std::move(reason)};
}

std::vector<SceneField> fields_of(const Scene& scene) {
  std::vector<SceneField> all;
  for_each_value(scene, [&](const std::string& path, const Field& field, double value) {
    const Range& range = field.range;
    all.push_back({path, value, std::string(field.symbol), std::string(field.unit), range.min, range.max,
                   range.min_open, range.max_open, range.reason});
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
  if (!is_number(given))
    throw nb::type_error(("with_values(): " + path + " must be a number; replace() sets words").c_str());
  const std::string no_number = "with_values(): " + path + " must be one real number";
  if (axes_of(given) > 0 || !is_real(given)) throw nb::type_error(no_number.c_str());
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
    if (!is_number(item[1]))
      throw nb::type_error(("with_values(): " + path + " " + says + "); replace() sets words").c_str());
    problems.push_back({path, number_at(path, item[1]), says + ")" + nearest(path, paths)});
  }
  for (const Problem& problem : check(scene)) problems.push_back(problem);
  raise_if(problems);
  return scene;
}

void bind_scene_field(nb::module_& m) {
  auto field =
      nb::class_<SceneField>(m, "SceneField", "A number of a scene: its path, its value and its bounds, in SI units.")
          .def_ro("path", &SceneField::path, "Path, as in problems: membrane[0].friction")
          .def_ro("value", &SceneField::value)
          .def_ro("symbol", &SceneField::symbol, "K06's")
          .def_ro("unit", &SceneField::unit)
          .def_ro("min", &SceneField::min)
          .def_ro("max", &SceneField::max)
          .def_ro("min_open", &SceneField::min_open, "Whether the value must be greater than min")
          .def_ro("max_open", &SceneField::max_open, "Whether the value must be less than max")
          .def_ro("reason", &SceneField::reason, "The reason for the bounds");
  def_init(field, &make_scene_field, nb::arg("path"), nb::arg("value"), nb::arg("symbol"), nb::arg("unit"),
           nb::arg("min"), nb::arg("max"), nb::arg("min_open"), nb::arg("max_open"), nb::arg("reason"),
           "Scene.fields() creates these objects.");
  def_value(field, {"path", "value", "symbol", "unit", "min", "max", "min_open", "max_open", "reason"});
}

}  // namespace

void bind_scene(nb::module_& m) {
  m.attr("longest_name") = longest_name;
  auto syringe = nb::class_<SyringeSettings>(m, "SyringeSettings", "The syringe on a scene's needle. docs/syringe.md")
                     .def_ro("syringe", &SyringeSettings::syringe)
                     .def_ro("thumb", &SyringeSettings::thumb, "The virtual coupling between thumb and plunger");
  def_init(syringe, &make_settings, nb::arg("syringe"), nb::arg("thumb") = SyringeSettings{}.thumb,
           "The scene that uses it checks all values.");
  def_value(syringe, {"syringe", "thumb"});

  const ServoSettings defaults;
  auto servo = nb::class_<ServoSettings>(m, "ServoSettings",
                                         "Rate of the servo loop, position conditioning and solver. K06 section 4")
                   .def_static("unchecked", &unchecked_servo, nb::arg("rate"), nb::arg("low_pass"), nb::arg("solver"),
                               nb::arg("conditioning"), nb::arg("encoder_step"), nb::arg("sub_steps"),
                               "Creates settings without checks of the numbers. The scene that uses them checks all.")
                   .def_ro("rate", &ServoSettings::rate, "1/T, Hz")
                   .def_ro("low_pass", &ServoSettings::low_pass, "Cutoff of conditioning \"low_pass\", Hz; 0 is off")
                   .def_prop_ro(
                       "solver", [](const ServoSettings& s) { return name_of(s.solver); },
                       nb::sig("def solver(self) -> typing.Literal['exact', 'paper']"), "\"exact\" or \"paper\"")
                   .def_prop_ro(
                       "conditioning", [](const ServoSettings& s) { return name_of(s.conditioning); },
                       nb::sig("def conditioning(self) -> typing.Literal['low_pass', 'line_fit']"),
                       "\"low_pass\" or \"line_fit\"")
                   .def_ro("encoder_step", &ServoSettings::encoder_step,
                           "Encoder step for conditioning \"line_fit\", m; 0 for an ideal sensor")
                   .def_ro("sub_steps", &ServoSettings::sub_steps,
                           "Steps of the model in a tick, a whole number from 1 to 16. docs/pop-time.md");
  def_init(servo, &make_servo, nb::arg("rate") = defaults.rate, nb::arg("low_pass") = defaults.low_pass,
           nb::arg("solver") = name_of(defaults.solver), nb::arg("conditioning") = name_of(defaults.conditioning),
           nb::arg("encoder_step") = defaults.encoder_step, nb::arg("sub_steps") = defaults.sub_steps,
           nb::sig("def __init__(self, rate: float = ..., low_pass: float = ..., solver: typing.Literal['exact', "
                   "'paper'] = ..., conditioning: typing.Literal['low_pass', 'line_fit'] = ..., encoder_step: float = "
                   "..., sub_steps: float = ...) -> None"),
           "rate: 1/T, Hz. solver: \"exact\" or \"paper\". conditioning: \"low_pass\" is K06's filter with cutoff\n"
           "low_pass (Hz; 0 is off); \"line_fit\" is for a device with encoders of step encoder_step (m; 0 is off).\n"
           "sub_steps: steps of the model in a tick, 1 to 16; more find the time of a pop better. Raises\n"
           "ConfigurationError.");
  def_value(servo, {"rate", "low_pass", "solver", "conditioning", "encoder_step", "sub_steps"});

  auto display = nb::class_<DisplaySettings>(m, "DisplaySettings", "How a device shows forces that it cannot give.")
                     .def_static("unchecked", &unchecked_display, nb::arg("force_scale"),
                                 "Creates settings without checks of the number. The scene that uses them checks it.")
                     .def_prop_ro(
                         "force_scale",
                         [](const DisplaySettings& d) {
                           return d.automatic ? ScaleOrWord("automatic") : ScaleOrWord(d.force_scale);
                         },
                         nb::sig("def force_scale(self) -> float | typing.Literal['automatic']"),
                         "How much of the model's force the device gives: a number, or \"automatic\"");
  def_init(display, &make_display, nb::arg("force_scale") = DisplaySettings{}.force_scale,
           nb::sig("def __init__(self, force_scale: float | typing.Literal['automatic'] = ...) -> None"),
           "force_scale: how much of the model's force the device gives, greater than 0 and at most 1. \"automatic\"\n"
           "lowers it so that the limits in use never cut the friction along the needle. Raises ConfigurationError.");
  def_value(display, {"force_scale"});

  bind_scene_field(m);
  auto scene =
      nb::class_<Scene>(m, "Scene", "All parameters of a run, checked together.")
          .def_ro("name", &Scene::name)
          .def_ro("needle", &Scene::needle)
          .def_ro("coupling", &Scene::coupling)
          .def_prop_ro(
              "membranes", [](const Scene& s) { return nb::tuple(nb::cast(s.membranes)); },
              nb::sig("def membranes(self) -> tuple[PlacedMembrane, ...]"))
          .def_ro("servo", &Scene::servo)
          .def_prop_ro(
              "direction", [](const Scene& s) { return s.direction == Direction::stylus ? "stylus" : "motion"; },
              nb::sig("def direction(self) -> typing.Literal['stylus', 'motion']"), "\"stylus\" or \"motion\"")
          .def_ro("display", &Scene::display)
          .def_ro("syringe", &Scene::syringe, "The syringe on the needle; None without one")
          .def_prop_ro(
              "relaxation", [](const Scene& s) { return nb::tuple(nb::cast(s.relaxation)); },
              nb::sig("def relaxation(self) -> tuple[MaxwellBranch, ...]"),
              "The branches beside the coupling that relax while the needle rests; empty in K06")
          .def_prop_ro(
              "lumen", [](const Scene& s) { return lumen(s); }, nb::sig("def lumen(self) -> tuple[int, int] | None"),
              "Indices of the two membranes with blood between them; None if there is no blood")
          .def("fields", &fields_of, nb::sig("def fields(self) -> list[SceneField]"),
               "All numbers of the scene, each with its path, unit and bounds.")
          .def("with_values", &with_values, nb::arg("values"),
               nb::sig("def with_values(self, values: dict[str, float]) -> Scene"),
               "A copy with changed numbers, by path, in SI units: {\"membrane[0].friction\": 0.3}. Raises\n"
               "ConfigurationError or TypeError.");
  def_init(
      scene, &make_scene, nb::arg("name"), nb::arg("needle"), nb::arg("coupling"), nb::arg("membranes"),
      nb::arg("servo") = defaults, nb::arg("direction") = "stylus", nb::arg("display") = DisplaySettings{},
      nb::arg("syringe") = nb::none(), nb::arg("relaxation") = nb::make_tuple(),
      nb::sig("def __init__(self, name: str, needle: Needle, coupling: Coupling, membranes: Sequence[PlacedMembrane], "
              "servo: ServoSettings = ..., direction: typing.Literal['stylus', 'motion'] = ..., display: "
              "DisplaySettings = ..., syringe: SyringeSettings | None = ..., relaxation: Sequence[MaxwellBranch] = "
              "...) -> None"),
      "direction: needle direction at entry, \"stylus\" (measured) or \"motion\" (the tip's path). relaxation: at\n"
      "most two branches beside the coupling. Raises ConfigurationError with all problems.");
  def_value(scene,
            {"name", "needle", "coupling", "membranes", "servo", "direction", "display", "syringe", "relaxation"});

  m.def(
      "unusual", [](const std::string& path, double written, double size) { return unusual(path, written, size); },
      nb::arg("path"), nb::arg("written"), nb::arg("size"),
      "What to write instead of a number that is off by a factor of 1,000; empty if it is not. written: in a unit of\n"
      "`size` in SI.");

  m.def("set_unusual_warnings", &set_unusual_warnings, nb::arg("on"),
        "Sets whether constructors warn in this thread of numbers in a probably wrong unit. Returns the value before.");
}

}  // namespace punctura::bindings
