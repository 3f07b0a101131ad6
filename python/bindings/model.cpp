// core/punctura/model: needle, membrane and the friction laws of K06 section 2.
#include <numbers>

#include "arguments.hpp"
#include "bindings.hpp"
#include "law_bounds.hpp"
#include "struct.hpp"

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
  def_struct<needle_fields>(m, {"Needle", "A needle: diameter w (m) and tip angle theta (rad). K06 Fig. 1", "needle"},
                            [](const Needle& made, std::vector<Problem>& problems) {
                              check(made, "needle", problems);
                              tell_radians(problems);
                            });
  def_struct<membrane_fields>(
      m, {"Membrane", "A membrane that grips the needle with dry friction. K06 section 2", "membrane"});

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
