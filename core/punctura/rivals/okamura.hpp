// Okamura, Simone, O'Leary 2004: stiffness to the puncture, then friction per depth and a constant cutting force.
#pragma once

#include <algorithm>
#include <array>

#include "punctura/rivals/elastic.hpp"

namespace punctura {

/// Okamura et al. 2004: f = a1 z + a2 z^2 to the puncture. From then on a friction of (C + b |v|) z, by a Karnopp
/// model, and a constant cutting force while the tip is deeper than ever before.
struct Okamura {
  static constexpr const char* name = "okamura";
  static constexpr const char* title = "Okamura 2004";
  static constexpr const char* source =
      "Okamura, Simone, O'Leary: Force modeling for needle insertion into soft tissue. IEEE TBME 51(10), 2004";

  double linear = 50;          ///< a1, N/m
  double quadratic = 5e3;      ///< a2, N/m^2
  double puncture = 8e-3;      ///< m
  double cutting = 0.5;        ///< N
  double friction_slope = 12;  ///< C, N/m
  double viscous_slope = 0;    ///< b, N s/m^2
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< half the width of Karnopp's dead band, m/s

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Okamura>;
    return std::array{
        N{&Okamura::linear, "linear", "N/m", 0, 1e5, "a1, linear stiffness to the puncture"},
        N{&Okamura::quadratic, "quadratic", "N/m^2", 0, 1e8, "a2, quadratic stiffness to the puncture"},
        N{&Okamura::puncture, "puncture", "m", 1e-5, 0.2, "depth of the puncture below the surface"},
        N{&Okamura::cutting, "cutting", "N", 0, 100, "cutting force while the tip is deeper than ever before"},
        N{&Okamura::friction_slope, "friction_slope", "N/m", 0, 2000, "C, friction per inserted length"},
        N{&Okamura::viscous_slope, "viscous_slope", "N s/m^2", 0, 1e5, "b, viscous friction per inserted length",
          Shows::speeds},
        N{&Okamura::out_ratio, "out_ratio", "-", 0, 10, "friction outwards over friction inwards", Shows::withdrawal},
        N{&Okamura::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which friction holds", Shows::setting},
    };
  }

  struct State {
    bool punctured = false;
    double deepest = 0;  ///< m
    DryFriction friction{};

    static void archive(auto& self, auto& state) { state.fields(self.punctured, self.deepest, self.friction); }
  };

  double load(const State&, double depth) const noexcept { return depth; }

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    const bool cuts = depth >= state.deepest;
    state.deepest = std::max(state.deepest, depth);
    if (!state.punctured && depth < puncture) return (linear + quadratic * depth) * depth;
    state.punctured = true;
    const double level = friction_slope * depth, viscous = viscous_slope * depth * velocity;
    const bool slides = velocity > dead_band || velocity < -dead_band;
    const double in = level + (cuts || !slides ? cutting : 0);
    return state.friction.step(in, out_ratio * level, velocity, dead_band) + (slides ? viscous : 0);
  }
};
static_assert(Punctures<Okamura>);

}  // namespace punctura
