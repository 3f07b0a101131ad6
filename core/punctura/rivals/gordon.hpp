// Gordon, Kim, Barnett, Moore 2015: a piecewise model, each piece with numbers of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "punctura/rivals/elastic.hpp"

namespace punctura {

/// A piecewise model after Gordon et al. 2015: an exponential rise to the puncture, an exponential fall behind it, then
/// a straight line. docs/rivals.md says which part of the source we could read.
struct Gordon : BehindPuncture {
  static constexpr const char* name = "gordon";
  static constexpr const char* title = "piecewise (Gordon 2015)";
  static constexpr const char* source =
      "Gordon, Kim, Barnett, Moore: Needle insertion force model for haptic simulation. ASME MSEC2015-9352, 2015";

  double scale = 0.1;   ///< N
  double growth = 200;  ///< 1/m
  double fall = 1e-3;   ///< length of the fall behind the puncture, m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Gordon>;
    return joined(std::array{N{&Gordon::scale, "scale", "N", 0, 1e3, "scale of the exponential rise"},
                             N{&Gordon::growth, "growth", "1/m", 1, 5000, "growth of the exponential rise"},
                             N{&Gordon::fall, "fall", "m", 1e-5, 0.05, "length of the fall behind the puncture"}},
                  behind<Gordon>());
  }

  struct State : PuncturedState {
    double peak = 0, deepest = 0;  ///< N at the puncture; m

    static void archive(auto& self, auto& state) {
      PuncturedState::archive(self, state);
      state.numbers(self.peak, self.deepest);
    }
  };

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    if (!state.punctured && depth < puncture) {
      state.peak = scale * std::expm1(std::min(growth * depth, 50.0));
      return state.peak;
    }
    state.punctured = true;
    state.deepest = std::max(state.deepest, depth);
    const double above = std::max(0.0, state.peak - friction - friction_slope * puncture);
    return slide(state, depth, velocity, above * std::exp(-std::max(0.0, state.deepest - puncture) / fall));
  }
};
static_assert(Punctures<Gordon>);

}  // namespace punctura
