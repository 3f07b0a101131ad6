// core/punctura/syringe: the plunger of a syringe under the thumb.
#include <tuple>

#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "punctura/syringe/plunger.hpp"
#include "punctura/syringe/syringe.hpp"
#include "state.hpp"
#include "struct.hpp"

#include <nanobind/stl/tuple.h>

namespace punctura::bindings {
namespace {

/// A plunger that keeps its constructor arguments.
struct GivenPlunger : Plunger, OneThread {
  Coupling given_coupling;
  double period;

  GivenPlunger(const Syringe& syringe, const Coupling& coupling, double period)
      : Plunger(syringe, coupling, period), given_coupling(coupling), period(period) {}
  nb::tuple arguments() const { return nb::make_tuple(syringe(), given_coupling, period); }
};

GivenPlunger make_plunger(Syringe syringe, Coupling coupling, double period) {
  std::vector<Problem> problems;
  check(coupling, problems);
  check_period(period, problems);
  raise_if(problems);
  return {syringe, coupling, period};
}

void check_depth(double depth) {
  if (!is_place(depth)) throw nb::value_error("p must be a finite depth within 1000 km, in m");
}

double checked_tube_resistance(double bore, double length) {
  if (!(bore > 0 && length > 0 && std::isfinite(bore) && std::isfinite(length)))
    throw nb::value_error("bore and length must be greater than 0 m and finite");
  return tube_resistance(bore, length);
}

using Layers = std::vector<std::tuple<double, double, Outlet, Outlet>>;

Outlet at_opening(const Layers& given, double length) {
  std::vector<LayerAtTip<double>> layers;
  for (const auto& [depth, path_length, inside, behind] : given) {
    if (!std::isfinite(depth) || !std::isfinite(path_length) || path_length < 0)
      throw nb::value_error("layers: each depth and path length must be finite, and no path length below 0 m");
    layers.push_back({depth, path_length, inside, behind});
  }
  if (!(length > 0 && std::isfinite(length))) throw nb::value_error("length must be greater than 0 m and finite");
  return outlet_at(std::span<const LayerAtTip<double>>(layers), length);
}

}  // namespace

void bind_syringe(nb::module_& m) {
  def_struct<syringe_fields>(
      m, {"Syringe", "A syringe with liquid, air, or both. docs/syringe.md", "syringe"},
      [](const Syringe& made, std::vector<Problem>& problems) { check(made, "syringe", problems); })
      .def_prop_ro("area", &Syringe::area, "Area of the plunger, m^2");
  def_struct<outlet_fields>(m, {"Outlet", "What the opening of a needle leads to. docs/syringe.md", "outlet"});

  auto plunger = nb::class_<GivenPlunger>(m, "Plunger", nb::is_final(),
                                          "The plunger of a syringe under the thumb, tick by tick. docs/syringe.md");
  def_init(plunger, &make_plunger, nb::arg("syringe"), nb::arg("coupling"), nb::arg("period"),
           "period: T, s. Raises ConfigurationError.");
  def_state(plunger);
  def_reset(plunger, "Resets to the full syringe.");
  def_repr(plunger, "<Plunger {0.phase.name}: {0.position:g} m, {0.force:g} N, {0.pressure:g} Pa>");
  plunger
      .def(
          "step",
          [](GivenPlunger& self, double p, const Outlet& outlet) {
            check_depth(p);
            return self.step(p, outlet);
          },
          nb::arg("p"), nb::arg("outlet"),
          "Makes one tick. Returns the force on the thumb, N; negative while it pushes.\n\n"
          "p: depth of the thumb, m, inwards from where the plunger starts. Raises ValueError.")
      .def(
          "peek",
          [](const GivenPlunger& self, double p, const Outlet& outlet) {
            check_depth(p);
            return Plunger(self).step(p, outlet);
          },
          nb::arg("p"), nb::arg("outlet"), "The force of step(p, outlet), without changing the state.");
  const Getters get{plunger};
  get("syringe", "The syringe at the start", [](auto& p) { return p.syringe(); });
  get("force", "f(k), N, on the thumb", [](auto& p) { return p.force(); });
  get("position", "q(k), m, of the plunger", [](auto& p) { return p.position(); });
  get("pressure", "P(k) above that of the atmosphere, Pa", [](auto& p) { return p.pressure(); });
  get("left", "Volume that left through the needle so far, m^3; negative if more came back",
      [](auto& p) { return p.left(); });
  get("liquid", "In the barrel now, m^3", [](auto& p) { return p.state.contents.liquid; });
  get("air", "In the barrel now, m^3 at the pressure of the atmosphere", [](auto& p) { return p.state.contents.air; });
  get("phase", "", [](auto& p) { return p.phase(); });

  m.def("tube_resistance", &checked_tube_resistance, nb::arg("bore"), nb::arg("length"),
        "Flow resistance of a tube for water at 20 C, Pa s/m^3, by Hagen and Poiseuille. bore, length: m. Raises\n"
        "ValueError.");
  m.def("outlet_at", &at_opening, nb::arg("layers"), nb::arg("length"),
        "One outlet for the layers beside a needle's opening of this length (m).\n\n"
        "layers, from the front to the back: depth of the point in the membrane (m; 0 outside), length of the\n"
        "needle's path through it (m), the outlet inside it, and that behind it. Raises ValueError.");
}

}  // namespace punctura::bindings
