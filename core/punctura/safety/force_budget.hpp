// The budget for continuous force: how much force the motors may still give.
#pragma once

#include "punctura/model/lane.hpp"

namespace punctura {

/// A token bucket of squared force, N^2 s. Squared force heats motors.
///
/// Guarantee: in no interval of length `window` (s) is the force above `rating` (N rms).
///
/// A window permits rating^2 * window. The depth of the bucket is a quarter of this, for bursts. The rest returns at
/// the constant rate `rate` (N^2). Therefore an interval of length t contains at most depth + rate * t. For t =
/// window this is rating^2 * window. A constant force can be at most sqrt(rate), 87 % of the rating.
///
/// The budget belongs to a device and outlasts a run, because motors do not cool when a new run begins.
template <typename Scalar>
class BasicForceBudget {
 public:
  static constexpr auto burst_share = Lane<Scalar>(0.25);

  /// window: s. rating: N rms.
  constexpr BasicForceBudget(Scalar window, Scalar rating) noexcept
      : depth_(burst_share * rating * rating * window), rate_((1 - burst_share) * rating * rating) {}

  /// Counts a force that was given for a time. square: the squared force, N^2. time: s. NaN empties the budget.
  constexpr void spend(Scalar square, Scalar time) noexcept {
    using namespace lane;
    const Scalar spent = spent_ + (square - rate_) * time;
    spent_ = select(spent == spent, min(max(spent, Scalar(0)), most()), most());
  }

  /// The square (N^2) of the largest force that the guarantee permits for a time (s), with so much (N^2 s) spent.
  constexpr Scalar permitted_square(Scalar time, Scalar spent) const noexcept {
    using namespace lane;
    return rate_ + max(Scalar(0), Scalar(depth_ - spent)) / time;
  }

  /// The part of the bucket that is left, 0 to 1.
  constexpr Scalar left() const noexcept {
    using namespace lane;
    return min(max(Scalar(1 - spent_ / depth_), Scalar(0)), Scalar(1));
  }

  /// The most that a burst can take, N^2 s.
  constexpr Scalar depth() const noexcept { return depth_; }

  /// The square (N^2) of the largest constant force.
  constexpr Scalar rate() const noexcept { return rate_; }

  /// The amount that was taken from the bucket and has not returned yet, N^2 s.
  constexpr Scalar spent() const noexcept { return spent_; }
  constexpr void set_spent(Scalar spent) noexcept {
    using namespace lane;
    spent_ = select(spent > 0, spent, Scalar(0));
  }

  static void archive(auto& self, auto& state) {
    state.fields(self.spent_);
    state.require(self.spent_ >= 0);
  }
  void describe(auto& parameters) const { parameters.fields(depth_, rate_); }

 private:
  /// The upper bound of spent_. With it, the budget has room again after a rest of `window` at the latest.
  constexpr Scalar most() const noexcept { return depth_ / burst_share; }

  Scalar depth_, rate_;
  Scalar spent_ = 0;
};

using ForceBudget = BasicForceBudget<double>;
using ForceBudgetF = BasicForceBudget<float>;

}  // namespace punctura
