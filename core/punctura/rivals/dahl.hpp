// Dahl 1968: friction with a spring of bristles, and viscosity beside it.
#pragma once

#include <array>
#include <cmath>

#include "punctura/rivals/rival.hpp"

namespace punctura {

/// dF/dz = s (1 - F/Fc sign(v)), Fc = friction + friction_slope z, and b v beside it. It has no puncture.
struct Dahl {
  static constexpr const char* name = "dahl";
  static constexpr const char* title = "Dahl with viscosity";
  static constexpr const char* source =
      "Dahl: A solid friction model. The Aerospace Corporation, TOR-0158(3107-18)-1, 1968";

  double stiffness = 500;      ///< s, N/m
  double friction = 0.5;       ///< N
  double friction_slope = 10;  ///< N/m
  double viscosity = 0;        ///< b, N s/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Dahl>;
    return std::array{
        N{&Dahl::stiffness, "stiffness", "N/m", 1, 1e5, "s, stiffness before sliding"},
        N{&Dahl::friction, "friction", "N", 1e-4, 100, "friction of sliding, constant part"},
        N{&Dahl::friction_slope, "friction_slope", "N/m", 0, 2000, "friction of sliding, per depth"},
        N{&Dahl::viscosity, "viscosity", "N s/m", 0, 1e3, "b, viscosity", Shows::speeds},
    };
  }

  struct State {
    double depth = 0, force = 0;  ///< m, N

    static void archive(auto& self, auto& state) { state.numbers(self.depth, self.force); }
  };

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    const double moved = depth - state.depth, level = friction + friction_slope * depth;
    const double towards = moved >= 0 ? level : -level;
    // The solution of the differential equation for a constant Fc over the step.
    state.force = towards + (state.force - towards) * std::exp(-stiffness * std::abs(moved) / level);
    state.depth = depth;
    return state.force + viscosity * velocity;
  }
};
static_assert(Rival<Dahl>);

}  // namespace punctura
