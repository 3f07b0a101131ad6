// The filter between encoders and model, K06 section 4.
#pragma once

#include <cmath>
#include <numbers>

namespace punctura {

/// First-order low-pass y += gain (x - y), gain = 1 - exp(-2 pi f T): the exact response to a held input.
///
/// K06 does not give the discretisation; at its 300 Hz and 1600 Hz explicit Euler (gain 2 pi f T = 1.18) would overshoot
/// (docs/errata.md, E5). The state starts at the first sample. A cutoff of 0 Hz is off: samples pass unchanged.
template <typename Scalar, typename Value = Scalar>
class LowPass {
 public:
  LowPass(Scalar cutoff_hz, Scalar period) noexcept
      : off_(cutoff_hz == 0), gain_(1 - std::exp(-2 * std::numbers::pi_v<Scalar> * cutoff_hz * period)) {}

  void reset() noexcept {
    started_ = false;
    y_ = {};
  }

  /// Goes on from where another filter is, with its own cutoff.
  void resume(const LowPass& previous) noexcept {
    y_ = previous.y_;
    started_ = previous.started_;
  }

  static void archive(auto& self, auto& state) {
    state.flag(self.started_);
    state.numbers(self.y_);
  }
  void describe(auto& parameters) const {
    parameters.flag(off_);
    parameters.numbers(gain_);
  }

  Value step(const Value& x) noexcept {
    if (off_ || !started_) {
      y_ = x;
    } else {
      y_ = y_ + gain_ * (x - y_);
    }
    started_ = true;
    return y_;
  }

  Scalar gain() const noexcept { return off_ ? Scalar{1} : gain_; }
  /// By how many ticks it is behind a steady motion.
  Scalar lag() const noexcept { return 1 / gain() - 1; }

 private:
  bool off_, started_ = false;
  Scalar gain_;
  Value y_{};
};

}  // namespace punctura
