// Hunt and Crossley 1975: a power of the depth, with damping in proportion to the elastic force.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "punctura/rivals/elastic.hpp"

namespace punctura {

/// f = k z^n (1 + a v) to the puncture, never less than 0; friction behind it.
struct HuntCrossley : BehindPuncture {
  static constexpr const char* name = "hunt_crossley";
  static constexpr const char* title = "Hunt-Crossley";
  static constexpr const char* source =
      "Hunt, Crossley: Coefficient of restitution interpreted as damping in vibroimpact. J. Appl. Mech. 42(2), 1975";

  double peak = 1;      ///< k puncture^n: the elastic force at the puncture, N
  double exponent = 2;  ///< n
  double damping = 0;   ///< a, s/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<HuntCrossley>;
    return joined(
        std::array{
            N{&HuntCrossley::peak, "peak", "N", 0, 100, "k puncture^n, the elastic force at the puncture"},
            N{&HuntCrossley::exponent, "exponent", "-", 0.2, 8, "n, exponent of the depth"},
            N{&HuntCrossley::damping, "damping", "s/m", 0, 1000, "a, damping over elastic force", Shows::speeds}},
        behind<HuntCrossley>());
  }

  using State = PuncturedState;

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    if (!state.punctured && depth < puncture)
      return peak * std::pow(depth / puncture, exponent) * std::max(0.0, 1 + damping * velocity);
    state.punctured = true;
    return slide(state, depth, velocity);
  }
};
static_assert(Punctures<HuntCrossley>);

}  // namespace punctura
