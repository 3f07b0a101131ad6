// Dry friction with a dead band of the velocity, after Karnopp.
#pragma once

#include <algorithm>

namespace punctura {

/// Dry friction after Karnopp (1985): outside the dead band the friction is that of sliding. Inside the dead band it
/// keeps its last value, but it is never stronger than the friction of sliding.
///
/// Karnopp takes the applied force inside the dead band. A device with a commanded force does not measure it, so the
/// last value stands for it.
struct DryFriction {
  double held = 0;  ///< N

  /// in, out: friction of sliding inwards and outwards, N, both 0 or more. dead_band: m/s.
  double step(double in, double out, double velocity, double dead_band) noexcept {
    if (velocity > dead_band)
      held = in;
    else if (velocity < -dead_band)
      held = -out;
    else
      held = std::clamp(held, -out, in);
    return held;
  }

  static void archive(auto& self, auto& state) { state.numbers(self.held); }
};

}  // namespace punctura
