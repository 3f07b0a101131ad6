// Rupture after Mahvash and Dupont 2010: a nonlinear viscoelastic tissue breaks at an energy.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "punctura/rivals/elastic.hpp"

namespace punctura {

/// A nonlinear Kelvin solid: f = (1 + r) g(z) at once and g(z) after a long time, with g(z) = k z^n. It breaks when the
/// stored energy reaches `puncture`. A faster needle stores more energy at the same depth, so it breaks the tissue
/// earlier. Friction behind it.
///
/// The paper compares the energy release rate of the crack with the toughness. Here the stored energy takes its place,
/// because one trace does not show the size of the crack.
struct MahvashDupont {
  static constexpr const char* name = "mahvash_dupont";
  static constexpr const char* title = "rupture (Mahvash, Dupont 2010)";
  static constexpr const char* source =
      "Mahvash, Dupont: Mechanics of dynamic needle insertion into a biological material. IEEE TBME 57(4), 2010";

  double at_1_mm = 0.05;       ///< k (1 mm)^n: the slow elastic force at a depth of 1 mm, N
  double exponent = 1.5;       ///< n
  double ratio = 0.3;          ///< r, force of the branch that relaxes over the slow force
  double relaxation = 1;       ///< s
  double puncture = 1e-3;      ///< stored energy at the rupture, J
  double friction = 0.3;       ///< N
  double friction_slope = 10;  ///< N/m
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< m/s

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<MahvashDupont>;
    using M = MahvashDupont;
    return std::array{
        N{&M::at_1_mm, "at_1_mm", "N", 0, 100, "slow elastic force at a depth of 1 mm"},
        N{&M::exponent, "exponent", "-", 0.2, 8, "n, exponent of the depth"},
        N{&M::ratio, "ratio", "-", 0, 20, "r, force that relaxes over the slow force", Shows::speeds},
        N{&M::relaxation, "relaxation", "s", 0.02, 100, "relaxation time", Shows::speeds},
        N{&M::puncture, "puncture", "J", 1e-9, 10, "stored energy at the rupture"},
        N{&M::friction, "friction", "N", 0, 100, "friction behind the puncture, constant part"},
        N{&M::friction_slope, "friction_slope", "N/m", 0, 2000, "friction behind the puncture, per depth"},
        N{&M::out_ratio, "out_ratio", "-", 0, 10, "friction outwards over friction inwards", Shows::withdrawal},
        N{&M::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which friction holds", Shows::setting},
    };
  }

  struct State {
    bool punctured = false;
    double slow = 0;      ///< g at the last call, N
    double relaxing = 0;  ///< force of the branch that relaxes, N
    double depth = 0;     ///< m
    double energy = 0;    ///< stored, J
    DryFriction friction{};

    static void archive(auto& self, auto& state) {
      state.fields(self.punctured, self.slow, self.relaxing, self.depth, self.energy, self.friction);
    }
  };

  double load(const State& state, double) const noexcept { return state.energy; }

  double resistance(State& state, double depth, double velocity, double period) const noexcept {
    if (!state.punctured) {
      const double slow = at_1_mm * std::pow(depth * 1e3, exponent);
      // The Maxwell branch, exact for a force g that changes linearly over the period.
      const double x = period / relaxation, gone = -std::expm1(-x), share = x > 1e-6 ? gone / x : 1 - x / 2;
      const double relaxing = state.relaxing * (1 - gone) + ratio * (slow - state.slow) * share;
      // Stored: the integral of g, and of the branch's spring, whose stiffness is that of r g at this depth.
      const double spring = ratio * exponent * slow / std::max(depth, 1e-9);
      state.energy = slow * depth / (exponent + 1) + (spring > 0 ? relaxing * relaxing / (2 * spring) : 0);
      state.slow = slow;
      state.relaxing = relaxing;
      state.depth = depth;
      if (state.energy < puncture) return std::max(0.0, slow + relaxing);
      state.punctured = true;
    }
    const double level = friction + friction_slope * depth;
    return state.friction.step(level, out_ratio * level, velocity, dead_band);
  }
};
static_assert(Punctures<MahvashDupont>);

}  // namespace punctura
