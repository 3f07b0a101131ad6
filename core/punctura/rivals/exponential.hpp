// An exponential force to the puncture.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "punctura/rivals/elastic.hpp"

namespace punctura {

/// f = f0 (exp(b z) - 1) to the puncture, as Maurin et al. 2004 fitted it to punctures in vivo; friction behind it.
struct Exponential : BehindPuncture {
  static constexpr const char* name = "exponential";
  static constexpr const char* title = "exponential to puncture (Maurin 2004)";
  static constexpr const char* source =
      "Maurin et al.: In vivo study of forces during needle insertions. Perspective in Image-Guided Surgery, 2004";

  double scale = 0.1;   ///< f0, N
  double growth = 200;  ///< b, 1/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Exponential>;
    return joined(std::array{N{&Exponential::scale, "scale", "N", 0, 1e3, "f0, scale of the exponential rise"},
                             N{&Exponential::growth, "growth", "1/m", 1, 5000, "b, growth of the exponential rise"}},
                  behind<Exponential>());
  }

  using State = PuncturedState;

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    if (!state.punctured && depth < puncture) return scale * std::expm1(std::min(growth * depth, 50.0));
    state.punctured = true;
    return slide(state, depth, velocity);
  }
};
static_assert(Punctures<Exponential>);

}  // namespace punctura
