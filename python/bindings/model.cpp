// core/punctura/model: needle, membrane and the friction laws of K06 section 2.
#include <numbers>

#include "arguments.hpp"
#include "bindings.hpp"
#include "law_bounds.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

/// Adds the angle in radians to the problem of an angle that can be meant in degrees.
void tell_radians(std::vector<Problem>& problems) {
  for (Problem& problem : problems) {
    if (problem.path != "needle.tip_angle" || !(problem.value > 0 && problem.value < 90)) continue;
    problem.reason += ". If you meant " + decimal_text(problem.value, 6) + " degrees, write " +
                      decimal_text(problem.value * std::numbers::pi / 180, 4) + ": the angle is in rad";
  }
}

Needle make_needle(double diameter, double tip_angle) {
  const Needle made{diameter, tip_angle};
  std::vector<Problem> problems;
  check(made, "needle", problems);
  tell_radians(problems);
  raise_if(problems);
  warn_unusual("needle.diameter", diameter);
  return made;
}

Membrane make_membrane(double stiffness, double precompression, double friction, double thickness) {
  const Membrane made{stiffness, precompression, friction, thickness};
  std::vector<Problem> problems;
  check(made, "membrane", problems);
  raise_if(problems);
  warn_unusual("membrane.stiffness", stiffness);
  warn_unusual("membrane.precompression", precompression);
  warn_unusual("membrane.thickness", thickness);
  return made;
}

GivenThinLaw make_thin_law(Needle needle, Membrane membrane) {
  raise_if(problems_of(needle, membrane));
  return {{needle, membrane}, needle, membrane};
}

GivenThickLaw make_thick_law(Needle needle, Membrane membrane, double obliquity) {
  auto problems = problems_of(needle, membrane);
  check_field(obliquity_field, obliquity, "", problems);
  raise_if(problems);
  return {{needle, membrane, obliquity}, needle, membrane, obliquity};
}

template <typename L>
nb::class_<L> bind_law(nb::module_& m, const char* name, const char* doc) {
  auto law = nb::class_<L>(m, name, doc);
  law.def_ro("needle", &L::needle)
      .def_ro("membrane", &L::membrane)
      .def_prop_ro(
          "X", [](const L& l) { return l.constants().X; }, "Length of the tip, m. K06 (15)")
      .def_prop_ro(
          "A_I", [](const L& l) { return l.constants().A_I; }, "Growth of the insertion force, N/m. K06 (15)")
      .def_prop_ro(
          "A_O", [](const L& l) { return l.constants().A_O; },
          "Growth of the withdrawal force, N/m; negative where the membrane expels the tip. K06 (15)")
      .def_prop_ro(
          "Q", [](const L& l) { return l.constants().Q; }, "Precompression as a depth, m. K06 (15)")
      .def_prop_ro("F", [](const L& l) { return l.constants().F; }, "Dry friction of the shaft, N. K06 (15)");
  def_bounds(law);
  return law;
}

}  // namespace

void bind_model(nb::module_& m) {
  auto needle = nb::class_<Needle>(m, "Needle", "A needle: diameter w (m) and tip angle theta (rad). K06 Fig. 1")
                    .def_static(
                        "unchecked", [](double diameter, double tip_angle) { return Needle{diameter, tip_angle}; },
                        nb::arg("diameter"), nb::arg("tip_angle"),
                        "Creates a needle without checks. The scene that uses it checks all values.")
                    .def_ro("diameter", &Needle::diameter, "w, m")
                    .def_ro("tip_angle", &Needle::tip_angle, "theta, rad");
  def_init(needle, &make_needle, nb::arg("diameter"), nb::arg("tip_angle"), "Raises ConfigurationError.");
  def_value(needle, {"diameter", "tip_angle"});

  auto membrane =
      nb::class_<Membrane>(m, "Membrane", "A membrane that grips the needle with dry friction. K06 section 2")
          .def_static(
              "unchecked",
              [](double stiffness, double precompression, double friction, double thickness) {
                return Membrane{stiffness, precompression, friction, thickness};
              },
              nb::arg("stiffness"), nb::arg("precompression"), nb::arg("friction"), nb::arg("thickness"),
              "Creates a membrane without checks. The scene that uses it checks all values.")
          .def_ro("stiffness", &Membrane::stiffness, "kappa, N/m")
          .def_ro("precompression", &Membrane::precompression, "c, N")
          .def_ro("friction", &Membrane::friction, "mu, -")
          .def_ro("thickness", &Membrane::thickness, "H, m; 0 selects the thin law");
  def_init(membrane, &make_membrane, nb::arg("stiffness"), nb::arg("precompression"), nb::arg("friction"),
           nb::arg("thickness"), "Raises ConfigurationError.");
  def_value(membrane, {"stiffness", "precompression", "friction", "thickness"});

  auto thin = bind_law<GivenThinLaw>(m, "ThinLaw",
                                     "Law of an infinitely thin membrane, crossed along its normal. K06 (13)(14)");
  def_init(thin, &make_thin_law, nb::arg("needle"), nb::arg("membrane"),
           "Raises ConfigurationError with all problems.");
  def_value(thin, {"needle", "membrane"});

  auto thick = bind_law<GivenThickLaw>(m, "ThickLaw",
                                       "Law of a membrane of thickness H, crossed at an obliquity beta. K06 (16)-(19)");
  def_init(thick, &make_thick_law, nb::arg("needle"), nb::arg("membrane"), nb::arg("obliquity") = 0.0,
           "obliquity: beta, rad. Raises ConfigurationError with all problems.");
  def_value(thick, {"needle", "membrane", "obliquity"});
  thick.def_ro("obliquity", &GivenThickLaw::obliquity, "beta, rad")
      .def_prop_ro("H", &GivenThickLaw::thickness, "Thickness, m")
      .def_prop_ro("U", &GivenThickLaw::path_length, "Length of the needle's path through the membrane, m. K06 (17)");
}

}  // namespace punctura::bindings
