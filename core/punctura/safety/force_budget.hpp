// How much force a device's motors have given lately, and how much they may still give.
#pragma once

#include <algorithm>
#include <cmath>

namespace punctura {

/// A token bucket of squared force, N^2 s, which is what heats motors. It keeps this promise: in no interval of length
/// `window` is the force above `rating` N rms.
///
/// A quarter of what the promise permits in a window is the bucket's depth, for bursts. The rest comes back evenly, at
/// `rate` N^2. So an interval of any length t holds at most depth + rate * t, and for t = window that is
/// rating^2 * window. A force that lasts is held at sqrt(rate), 87 % of the rating.
///
/// The budget belongs to a device: motors do not cool because a new run begins.
template <typename Scalar>
class BasicForceBudget {
 public:
  static constexpr Scalar burst_share = Scalar(0.25);

  /// window: s. rating: N rms.
  BasicForceBudget(Scalar window, Scalar rating) noexcept
      : depth_(burst_share * rating * rating * window), rate_((1 - burst_share) * rating * rating) {}

  /// Counts a force, squared, N^2, that was given for a time, s. A force that is not a number uses all up.
  void spend(Scalar square, Scalar time) noexcept {
    const Scalar spent = spent_ + (square - rate_) * time;
    spent_ = std::isnan(spent) ? most() : std::clamp(spent, Scalar(0), most());
  }

  /// The square, N^2, of the greatest force that the promise permits for a time, s.
  Scalar permitted_square(Scalar time) const noexcept { return rate_ + std::max(Scalar(0), depth_ - spent_) / time; }

  /// What is left of the bucket, 0 to 1.
  Scalar left() const noexcept { return std::clamp(1 - spent_ / depth_, Scalar(0), Scalar(1)); }

  /// The square, N^2, of the force that may be given without end.
  Scalar rate() const noexcept { return rate_; }

  /// What was taken from the bucket and has not come back yet, N^2 s.
  Scalar spent() const noexcept { return spent_; }
  void set_spent(Scalar spent) noexcept { spent_ = spent > 0 ? spent : 0; }

  static void archive(auto& self, auto& state) {
    state.numbers(self.spent_);
    state.require(self.spent_ >= 0);
  }
  void describe(auto& parameters) const { parameters.numbers(depth_, rate_); }

 private:
  /// More is not remembered: it comes back within `window`, whatever was given.
  Scalar most() const noexcept { return depth_ / burst_share; }

  Scalar depth_, rate_;
  Scalar spent_ = 0;
};

using ForceBudget = BasicForceBudget<double>;
using ForceBudgetF = BasicForceBudget<float>;

}  // namespace punctura
