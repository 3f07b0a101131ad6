// The low-pass between encoders and model, K06 section 4.
#pragma once

#include <cmath>
#include <numbers>

#include "punctura/model/lane.hpp"

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
  constexpr LowPass(Scalar cutoff_hz, Scalar period) noexcept
      : off_(cutoff_hz == 0),
        gain_(off_ ? Scalar(0) : 1 - std::exp(-2 * std::numbers::pi_v<Scalar> * cutoff_hz * period)) {}
  /// A filter with this gain of a sample, 0 to 1. off: where samples pass unchanged. For lanes, which have no exp().
  static constexpr LowPass of_gain(const Mask<Scalar>& off, const Scalar& gain) noexcept {
    LowPass filter;
    filter.off_ = off;
    filter.gain_ = gain;
    return filter;
  }

  /// A filter with the state of another one goes on from its samples, with its own cutoff.
  struct State {
    Mask<Scalar> started{};
    Value y{};  ///< the last result
  };
  State state{};

  /// Forgets the samples of these lanes.
  constexpr void restart(const Mask<Scalar>& lanes) noexcept { state.started = state.started && !lanes; }

  static void archive(auto& self, auto& state) { state.fields(self.state.started, self.state.y); }
  void describe(auto& parameters) const { parameters.fields(off_, gain_); }

  constexpr Value step(const Value& x) noexcept {
    using namespace lane;
    Value& y = state.y;
    y = select(off_ || !state.started, x, Value(y + gain_ * (x - y)));
    state.started = Mask<Scalar>(true);
    return y;
  }

  constexpr Mask<Scalar> started() const noexcept { return state.started; }  ///< whether it has had a sample
  constexpr Scalar gain() const noexcept {
    using namespace lane;
    return select(off_, Scalar(1), gain_);
  }
  /// The lag behind a steady motion, in ticks.
  constexpr Scalar lag() const noexcept { return 1 / gain() - 1; }

 private:
  constexpr LowPass() noexcept = default;

  Mask<Scalar> off_{};
  Scalar gain_{};
};

}  // namespace punctura
