// Stick and slip as in CHAI3D's cEffectStickSlip: a spring to the place of sticking, which is let go at a force.
#pragma once

#include <array>
#include <cmath>

#include "punctura/rivals/rival.hpp"

namespace punctura {

/// f = k (z - anchor). Beyond the largest force the anchor jumps to the needle, and the force to 0. It has no puncture.
struct StickSlip {
  static constexpr const char* name = "stick_slip";
  static constexpr const char* title = "stick-slip (CHAI3D)";
  static constexpr const char* source = "CHAI3D, class cEffectStickSlip: the rule, written anew";

  double stiffness = 1000;     ///< k, N/m
  double friction = 0.5;       ///< largest force, constant part, N
  double friction_slope = 10;  ///< largest force per depth, N/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<StickSlip>;
    return std::array{
        N{&StickSlip::stiffness, "stiffness", "N/m", 1, 1e5, "k, stiffness of sticking"},
        N{&StickSlip::friction, "friction", "N", 0, 100, "largest force, constant part"},
        N{&StickSlip::friction_slope, "friction_slope", "N/m", 0, 2000, "largest force, per depth"},
    };
  }

  struct State {
    double anchor = 0;  ///< m

    static void archive(auto& self, auto& state) { state.numbers(self.anchor); }
  };

  double resistance(State& state, double depth, double, double) const noexcept {
    const double force = stiffness * (depth - state.anchor);
    if (std::abs(force) <= friction + friction_slope * depth) return force;
    state.anchor = depth;
    return 0;
  }
};
static_assert(Rival<StickSlip>);

}  // namespace punctura
