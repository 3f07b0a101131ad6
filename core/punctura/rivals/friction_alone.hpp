// Rivals of friction alone, which have no puncture.
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

    static void archive(auto& self, auto& state) { state.fields(self.depth, self.force); }
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

    static void archive(auto& self, auto& state) { state.fields(self.anchor); }
  };

  double resistance(State& state, double depth, double, double) const noexcept {
    const double force = stiffness * (depth - state.anchor);
    if (std::abs(force) <= friction + friction_slope * depth) return force;
    state.anchor = depth;
    return 0;
  }
};
static_assert(Rival<StickSlip>);

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
