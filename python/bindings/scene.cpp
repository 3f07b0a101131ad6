// core/punctura/scene: what a run needs, and everything that can be wrong with it.
#include "punctura/scene/scene.hpp"

#include "bindings.hpp"
#include "punctura/scene/check.hpp"

namespace punctura::bindings {
namespace {

Direction direction_from(const std::string& name) {
  if (name == "stylus") return Direction::stylus;
  if (name == "motion") return Direction::motion;
  nb::object errors = nb::module_::import_("punctura.errors");
  nb::list list;
  list.append(errors.attr("Problem")("needle.direction", name, "must be \"stylus\" or \"motion\""));
  nb::object error = errors.attr("ConfigurationError")(list);
  PyErr_SetObject(error.type().ptr(), error.ptr());
  throw nb::python_error();
}

template <std::size_t n>
void describe_fields(nb::list& out, const char* path, const Field (&fields)[n]) {
  const auto text = [](std::string_view s) { return nb::str(s.data(), s.size()); };
  for (const Field& field : fields) {
    nb::dict d;
    d["path"] = std::string(path) + "." + std::string(field.name);
    d["symbol"] = text(field.symbol);
    d["unit"] = text(field.unit);
    d["min"] = field.range.min;
    d["max"] = field.range.max;
    d["min_open"] = field.range.min_open;
    d["max_open"] = field.range.max_open;
    d["reason"] = field.range.reason;
    out.append(d);
  }
}

}  // namespace

void bind_scene(nb::module_& m) {
  nb::class_<PlacedMembrane>(m, "PlacedMembrane", "A membrane in its place.")
      .def(nb::init<std::string, Membrane, Triple, Triple>(), nb::arg("name"), nb::arg("membrane"), nb::arg("point"),
           nb::arg("inward_normal"),
           "point: any point of the surface, m. inward_normal: a direction of any length but 0.")
      .def_rw("name", &PlacedMembrane::name)
      .def_rw("membrane", &PlacedMembrane::membrane)
      .def_rw("point", &PlacedMembrane::point, "Any point of the surface, m")
      .def_rw("inward_normal", &PlacedMembrane::inward_normal, "A direction of any length but 0")
      .def("__repr__", [](const PlacedMembrane& p) {
        return nb::str("PlacedMembrane({!r}, {!r}, point={!r}, inward_normal={!r})")
            .format(p.name, p.membrane, p.point, p.inward_normal);
      });

  const ServoSettings defaults;
  nb::class_<ServoSettings>(m, "ServoSettings", "Rate of the servo loop, position filter and solver. K06 section 4")
      .def(
          "__init__",
          [](ServoSettings* self, double rate, double low_pass, const std::string& solver) {
            new (self) ServoSettings{rate, low_pass, solver_from(solver, "servo.solver")};
          },
          nb::arg("rate") = defaults.rate, nb::arg("low_pass") = defaults.low_pass,
          nb::arg("solver") = name_of(defaults.solver),
          "rate: 1/T, Hz. low_pass: cutoff, Hz; 0 is off. solver: \"exact\" or \"paper\".")
      .def_rw("rate", &ServoSettings::rate, "1/T, Hz")
      .def_rw("low_pass", &ServoSettings::low_pass, "Cutoff of the position filter, Hz; 0 is off")
      .def_prop_rw(
          "solver", [](const ServoSettings& s) { return name_of(s.solver); },
          [](ServoSettings& s, const std::string& name) { s.solver = solver_from(name, "servo.solver"); },
          "\"exact\" or \"paper\"")
      .def("__repr__", [](const ServoSettings& s) {
        return nb::str("ServoSettings(rate={!r}, low_pass={!r}, solver={!r})")
            .format(s.rate, s.low_pass, name_of(s.solver));
      });

  nb::class_<Scene>(m, "Scene", "Everything a run needs. Checked as a whole when it is built or run; see problems().")
      .def(
          "__init__",
          [](Scene* self, const std::string& name, const Needle& needle, const Coupling& coupling,
             const std::vector<PlacedMembrane>& membranes, const ServoSettings& servo, const std::string& direction) {
            Scene scene{name, needle, coupling, membranes, servo, direction_from(direction)};
            raise_if(check(scene));
            new (self) Scene(std::move(scene));
          },
          nb::arg("name"), nb::arg("needle"), nb::arg("coupling"), nb::arg("membranes"), nb::arg("servo") = defaults,
          nb::arg("direction") = "stylus",
          "direction: \"stylus\", as measured at entry, or \"motion\", as the tip has come. Raises ConfigurationError with all problems.")
      .def_rw("name", &Scene::name)
      .def_rw("needle", &Scene::needle)
      .def_rw("coupling", &Scene::coupling)
      .def_rw("membranes", &Scene::membranes)
      .def_rw("servo", &Scene::servo)
      .def_prop_rw(
          "direction", [](const Scene& s) { return s.direction == Direction::stylus ? "stylus" : "motion"; },
          [](Scene& s, const std::string& name) { s.direction = direction_from(name); }, "\"stylus\" or \"motion\"")
      .def("__repr__", [](const Scene& s) {
        return nb::str("<Scene {!r}: {} membrane{}>")
            .format(s.name, s.membranes.size(), s.membranes.size() == 1 ? "" : "s");
      });

  m.def(
      "scene_problems",
      [](const std::string& name, const Needle& needle, const Coupling& coupling,
         const std::vector<PlacedMembrane>& membranes, const ServoSettings& servo) {
        nb::list out;
        for (const Problem& p : check(Scene{name, needle, coupling, membranes, servo, {}}))
          out.append(nb::make_tuple(p.path, p.value, p.reason));
        return out;
      },
      nb::arg("name"), nb::arg("needle"), nb::arg("coupling"), nb::arg("membranes"), nb::arg("servo"),
      nb::sig("def scene_problems(name: str, needle: Needle, coupling: Coupling, membranes: Sequence[PlacedMembrane], "
              "servo: ServoSettings) -> list[tuple[str, float, str]]"),
      "All problems of a scene that need not be sound: (path, value in SI, reason).");

  m.def(
      "fields",
      [] {
        nb::list out;
        describe_fields(out, "needle", needle_fields);
        describe_fields(out, "membrane", membrane_fields);
        describe_fields(out, "coupling", coupling_fields);
        describe_fields(out, "servo", servo_fields);
        return out;
      },
      nb::sig("def fields() -> list[dict[str, typing.Any]]"),
      "Symbol, unit and bounds of every number in a scene, SI: the one place where bounds stand.");
}

}  // namespace punctura::bindings
