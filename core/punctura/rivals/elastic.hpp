// The state and the friction behind the puncture that several rivals share.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "punctura/rivals/dry_friction.hpp"
#include "punctura/rivals/rival.hpp"

namespace punctura {

/// The state of a layer that resists by elasticity until it is punctured, and by friction from then on.
struct PuncturedState {
  bool punctured = false;
  DryFriction friction{};

  static void archive(auto& self, auto& state) {
    state.flag(self.punctured);
    DryFriction::archive(self.friction, state);
  }
};

/// The numbers behind the puncture. Okamura et al. 2004 found friction in proportion to the inserted length. The
/// constant part stands for cutting and for the grip of a thin layer.
///
/// R derives from it and adds the elastic part.
struct BehindPuncture {
  double puncture = 5e-3;      ///< m
  double friction = 0.3;       ///< N
  double friction_slope = 10;  ///< N/m, of the inserted length
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< m/s

  template <typename R>
  static constexpr auto behind() noexcept {
    return std::array{
        RivalNumber<R>{&R::puncture, "puncture", "m", 1e-5, 0.2, "depth of the puncture below the surface"},
        RivalNumber<R>{&R::friction, "friction", "N", 0, 100, "friction behind the puncture, constant part"},
        RivalNumber<R>{&R::friction_slope, "friction_slope", "N/m", 0, 2000, "friction behind the puncture, per depth"},
        RivalNumber<R>{&R::out_ratio, "out_ratio", "-", 0, 10, "friction outwards over friction inwards",
                       Shows::withdrawal},
        RivalNumber<R>{&R::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which friction holds",
                       Shows::setting},
    };
  }

  double load(const PuncturedState&, double depth) const noexcept { return depth; }

  /// The friction behind the puncture, N. extra: further force while the needle slides in, N.
  double slide(PuncturedState& state, double depth, double velocity, double extra = 0) const noexcept {
    const double level = friction + friction_slope * depth;
    return state.friction.step(level + extra, out_ratio * level, velocity, dead_band);
  }
};

/// Joins the numbers of the elastic part and those behind the puncture.
template <typename Number, std::size_t n, std::size_t m>
constexpr std::array<Number, n + m> joined(const std::array<Number, n>& a, const std::array<Number, m>& b) noexcept {
  std::array<Number, n + m> all{};
  std::copy(a.begin(), a.end(), all.begin());
  std::copy(b.begin(), b.end(), all.begin() + n);
  return all;
}

}  // namespace punctura
