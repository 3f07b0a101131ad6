// The low-pass between encoders and model, K06 section 4.
#pragma once

#include <cmath>
#include <numbers>

namespace punctura {

/// A first-order low-pass: y += gain (x - y) with gain = 1 - exp(-2 pi f T). This is the exact response to a held
/// input.
///
/// K06 does not give the discretization. With its 300 Hz and 1600 Hz, explicit Euler (gain 2 pi f T = 1.18) would
/// overshoot (docs/errata.md, E5). y starts at the first sample. A cutoff of 0 Hz switches the filter off: samples
/// pass unchanged.
template <typename Scalar, typename Value = Scalar>
class LowPass {
 public:
  LowPass(Scalar cutoff_hz, Scalar period) noexcept
      : off_(cutoff_hz == 0), gain_(1 - std::exp(-2 * std::numbers::pi_v<Scalar> * cutoff_hz * period)) {}

  void reset() noexcept {
    started_ = false;
    y_ = {};
  }

  /// Takes over the state of another filter, but keeps its own cutoff.
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

  bool started() const noexcept { return started_; }  ///< whether it has had a sample
  const Value& last() const noexcept { return y_; }   ///< the last result
  Scalar gain() const noexcept { return off_ ? Scalar{1} : gain_; }
  /// The lag behind a steady motion, in ticks.
  Scalar lag() const noexcept { return 1 / gain() - 1; }

 private:
  bool off_, started_ = false;
  Scalar gain_;
  Value y_{};
};

}  // namespace punctura
