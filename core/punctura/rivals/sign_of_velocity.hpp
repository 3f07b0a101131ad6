// Friction by the sign of the velocity, with a dead band: what many first simulators do.
#pragma once

#include <array>

#include "punctura/rivals/rival.hpp"

namespace punctura {

/// F sign(v), F = friction + friction_slope z; 0 inside the dead band. It has no puncture.
struct SignOfVelocity {
  static constexpr const char* name = "sign_of_velocity";
  static constexpr const char* title = "-F sign(v) with dead band";
  static constexpr const char* source = "Coulomb's law in its simplest discrete form; no single source";

  double friction = 0.5;       ///< N
  double friction_slope = 10;  ///< N/m
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< m/s

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<SignOfVelocity>;
    return std::array{
        N{&SignOfVelocity::friction, "friction", "N", 0, 100, "F, constant part"},
        N{&SignOfVelocity::friction_slope, "friction_slope", "N/m", 0, 2000, "F per depth"},
        N{&SignOfVelocity::out_ratio, "out_ratio", "-", 0, 10, "F outwards over F inwards", Shows::withdrawal},
        N{&SignOfVelocity::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which the force is 0",
          Shows::setting},
    };
  }

  struct State {
    static void archive(auto&, auto&) {}
  };

  double resistance(State&, double depth, double velocity, double) const noexcept {
    const double level = friction + friction_slope * depth;
    return velocity > dead_band ? level : velocity < -dead_band ? -out_ratio * level : 0;
  }
};
static_assert(Rival<SignOfVelocity>);

}  // namespace punctura
