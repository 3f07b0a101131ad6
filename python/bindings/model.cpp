// core/punctura/model: needle, membrane and the friction laws of K06 section 2.
#include <numbers>

#include "arguments.hpp"
#include "bindings.hpp"
#include "law_bounds.hpp"
#include "state.hpp"
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

constexpr std::tuple thin_rows{row("needle", &ThinArguments::needle), row("membrane", &ThinArguments::membrane)};
constexpr std::tuple thick_rows{
    row("needle", &ThickArguments::needle),
    row("membrane", &ThickArguments::membrane),
    row("obliquity", &ThickArguments::obliquity, "beta, rad."),
};

/// Defines the class of a law with K06's constants.
template <const auto& rows, typename L>
auto bind_law(nb::module_& m, const char* name, const char* doc) {
  const auto check = [](const auto& made, std::vector<Problem>& problems) {
    problems = problems_of(made.needle, made.membrane);
    if constexpr (requires { made.obliquity; }) check_field(obliquity_field, made.obliquity, "", problems);
  };
  auto law = def_struct<rows, L>(
      m, {.name = name, .doc = doc, .raises = "Raises ConfigurationError with all problems.", .needed = 2}, check);
  const Getters get{law};
  get("X", "Length of the tip, m. K06 (15)", [](auto& l) { return l.constants().X; });
  get("A_I", "Growth of the insertion force, N/m. K06 (15)", [](auto& l) { return l.constants().A_I; });
  get("A_O", "Growth of the withdrawal force, N/m; negative where the membrane expels the tip. K06 (15)",
      [](auto& l) { return l.constants().A_O; });
  get("Q", "Precompression as a depth, m. K06 (15)", [](auto& l) { return l.constants().Q; });
  get("F", "Dry friction of the shaft, N. K06 (15)", [](auto& l) { return l.constants().F; });
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

  bind_law<thin_rows, GivenThinLaw>(m, "ThinLaw",
                                    "Law of an infinitely thin membrane, crossed along its normal. K06 (13)(14)");
  auto thick = bind_law<thick_rows, GivenThickLaw>(
      m, "ThickLaw", "Law of a membrane of thickness H, crossed at an obliquity beta. K06 (16)-(19)");
  thick.def_prop_ro("H", &GivenThickLaw::thickness, "Thickness, m")
      .def_prop_ro("U", &GivenThickLaw::path_length, "Length of the needle's path through the membrane, m. K06 (17)");
}

}  // namespace punctura::bindings
