// Kelvin-Voigt: a spring beside a damper, as Barbe et al. 2007 estimated it in vivo.
#pragma once

#include <algorithm>
#include <array>

#include "punctura/rivals/elastic.hpp"

namespace punctura {

/// f = k z + b v to the puncture, never less than 0; friction behind it. Constant k and b for a layer.
struct KelvinVoigt : BehindPuncture {
  static constexpr const char* name = "kelvin_voigt";
  static constexpr const char* title = "Kelvin-Voigt (Barbe 2007)";
  static constexpr const char* source = "Barbe et al., Int. J. Robotics Research 26(11-12), 2007";

  double stiffness = 100;  ///< k, N/m
  double damping = 0;      ///< b, N s/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<KelvinVoigt>;
    return joined(
        std::array{N{&KelvinVoigt::stiffness, "stiffness", "N/m", 0, 1e5, "k, stiffness to the puncture"},
                   N{&KelvinVoigt::damping, "damping", "N s/m", 0, 1e3, "b, damping to the puncture", Shows::speeds}},
        behind<KelvinVoigt>());
  }

  using State = PuncturedState;

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    if (!state.punctured && depth < puncture) return std::max(0.0, stiffness * depth + damping * velocity);
    state.punctured = true;
    return slide(state, depth, velocity);
  }
};
static_assert(Punctures<KelvinVoigt>);

}  // namespace punctura
