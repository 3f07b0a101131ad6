// The limits on the force for the device. Each limit that acts is counted and reported.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "punctura/model/omni.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/safety/force_budget.hpp"
#include "punctura/safety/input_gate.hpp"

namespace punctura {

/// The limits on the force for the device.
struct ForceLimits {
  double max_force = Omni::max_force;                ///< N, norm
  double continuous_force = Omni::continuous_force;  ///< N rms in any interval of continuous_time
  double continuous_time = 10;  ///< s. A chosen value: no data sheet gives the thermal time constant of the motors
  double ramp_time = 0.5;       ///< s from zero force to full force after arming
  double warm_motor = 0.8;      ///< motor temperature, 0 to 1, above which the ceiling decreases at once; it is 0 N at
                                ///< 1. It takes continuous_time to return from there: no motor cools faster
};

/// The largest force that these limits permit for any time, N. Motors that get warm can lower it further.
inline double lasting_force(const ForceLimits& limits) noexcept {
  return std::min(limits.max_force,
                  std::sqrt(BasicForceBudget<double>(limits.continuous_time, limits.continuous_force).rate()));
}

/// The limit that makes the force of a tick smaller than the force of the model times the force scale.
enum class Limit : std::uint8_t {
  none,         ///< no limit acts, or the force of the model is zero
  ramp,         ///< the ramp after arming
  peak,         ///< max_force
  continuous,   ///< continuous_force: the budget lowers the ceiling
  temperature,  ///< the device reports warm motors
};

/// How often each limit has acted, in ticks.
struct LimitCounters {
  std::uint64_t peak = 0, continuous = 0, temperature = 0, ramp = 0;
};

/// Limits the force: a ramp after arming, a budget for continuous force and a ceiling on the norm.
///
/// It clamps the norm of the force, not its components: this keeps the direction.
///
/// While more than half of the budget is left, the ceiling is max_force. With less than half, the ceiling decreases
/// linearly to the largest constant force. The ceiling increases again only while the force is below this constant
/// force. A limited force therefore never increases by itself. The rate of change has no limit, because the pop is an
/// intended step.
///
/// A device holds a force until the next tick, also if this tick is late. Therefore each tick counts the force of the
/// previous tick, for the time that has passed.
template <typename Scalar>
class BasicForceLimiter {
 public:
  using Vector = Vector3<Scalar>;
  /// The budget always has room for a device that holds a force for this time, s: the ordinary deadline of the gate.
  /// A longer deadline can exceed the continuous force (docs/safety.md).
  static constexpr Scalar longest_hold = static_cast<Scalar>(GateLimits{}.deadline);
  static constexpr Scalar unknown_time = -1;  ///< `elapsed` of a tick whose time is not known: one period counts

  BasicForceLimiter(const ForceLimits& limits, Scalar period) noexcept
      : max_force_(static_cast<Scalar>(limits.max_force)),
        warm_motor_(static_cast<Scalar>(limits.warm_motor)),
        budget_(static_cast<Scalar>(limits.continuous_time), static_cast<Scalar>(limits.continuous_force)),
        period_(period),
        steady_(std::min(max_force_, std::sqrt(budget_.rate()))),
        full_(steady_ + (max_force_ - steady_)),
        hold_(std::max(period, longest_hold)),
        ramp_step_(period / static_cast<Scalar>(limits.ramp_time)),
        cooling_step_(period / static_cast<Scalar>(limits.continuous_time)) {
    // Up to half of the budget the share in permitted() is 1, and there is the least room for a hold at the half.
    const Scalar half = budget_.depth() / 2;
    const Scalar square = full_ * full_;
    full_until_ = square > smallest_square && budget_.permitted_square(hold_, half) >= square ? half : -1;
    ceiling_ = permitted();
  }

  /// Starts a new ramp. The budget and the counters stay, because motors do not cool by a reset.
  void reset() noexcept { gain_ = 0; }

  /// Takes over the ramp, the budget and the counters of another limiter, but keeps its own limits.
  void resume(const BasicForceLimiter& previous) noexcept {
    gain_ = previous.gain_;
    cool_ = previous.cool_;
    held_square_ = previous.held_square_;
    counters_ = previous.counters_;
    budget_.set_spent(previous.budget_.spent());
  }

  /// One tick. wanted: the force of the model times the force scale, N, finite. Returns the force for the device, N.
  /// motor_temperature: 0 to 1. elapsed: s since the previous tick; NaN in the first tick of a run; a period if it is
  /// left out.
  Vector step(const Vector& wanted, Scalar motor_temperature = 0, Scalar elapsed = unknown_time) noexcept {
    count(elapsed);
    gain_ = std::min(Scalar(1), gain_ + ramp_step_);
    if (gain_ < 1 && wanted != Vector()) act(Limit::ramp, counters_.ramp);
    Vector force = gain_ * wanted;

    feel(motor_temperature);
    ceiling_ = permitted();
    held_square_ = force.squaredNorm();
    // Most forces are far enough below the ceiling that rounding cannot matter. They need no root. Denormal squares are
    // too coarse for this comparison.
    const Scalar below = Scalar(0.999) * ceiling_ * ceiling_;
    if (!(held_square_ < below && below > smallest_square)) {
      force = clamped(force);
      held_square_ = force.squaredNorm();
    }
    return force;
  }

  /// One tick without force. motor_temperature: 0 to 1. elapsed: s since the previous tick, as in step().
  void rest(Scalar motor_temperature = 0, Scalar elapsed = unknown_time) noexcept {
    count(elapsed);
    feel(motor_temperature);
    ceiling_ = permitted();
  }

  /// Ends a run. The device has held the last force for `elapsed` (s) and now gives no force.
  void end(Scalar elapsed) noexcept { count(elapsed); }

  Scalar ceiling() const noexcept { return ceiling_; }  ///< the largest force that the last tick permitted, N
  Limit limit() const noexcept { return limit_; }       ///< the limit that reduced the force of the last tick
  Scalar gain() const noexcept { return gain_; }        ///< gain of the ramp, 0 to 1
  const LimitCounters& counters() const noexcept { return counters_; }

  const BasicForceBudget<Scalar>& budget() const noexcept { return budget_; }
  /// Sets how much the motors of the device have given before, N^2 s. See ForceBudget::spent.
  void set_spent(Scalar spent) noexcept { budget_.set_spent(spent); }

  static void archive(auto& self, auto& state) {
    BasicForceBudget<Scalar>::archive(self.budget_, state);
    state.numbers(self.gain_, self.cool_, self.ceiling_, self.held_square_);
    state.require(self.gain_ >= 0 && self.gain_ <= 1 && self.cool_ >= 0 && self.cool_ <= 1 && self.held_square_ >= 0);
    state.choice(self.limit_, Limit::temperature);
    constexpr auto any = std::numeric_limits<std::uint64_t>::max();
    for (auto* counter :
         {&self.counters_.peak, &self.counters_.continuous, &self.counters_.temperature, &self.counters_.ramp})
      state.index(*counter, any);
  }
  void describe(auto& parameters) const {
    budget_.describe(parameters);
    parameters.numbers(max_force_, warm_motor_, period_, steady_, hold_, ramp_step_);
  }

 private:
  /// Warm motors reduce the ceiling at once. It returns slowly, so that a sensor that fails now and then cannot switch
  /// the force on and off. NaN reduces it to 0.
  void feel(Scalar temperature) noexcept {
    const Scalar cooler = std::min(Scalar(1), cool_ + cooling_step_);
    if (temperature <= warm_motor_)
      cool_ = cooler;
    else
      cool_ = std::min(cooler, std::max(Scalar(0), (1 - temperature) / (1 - warm_motor_)));
  }

  /// A force whose norm is at most the ceiling, with the direction of `force`.
  Vector clamped(const Vector& force) noexcept {
    const Scalar norm = force.stableNorm();
    if (norm <= ceiling_) return force;
    if (cool_ < 1)
      act(Limit::temperature, counters_.temperature);
    else if (ceiling_ < max_force_)
      act(Limit::continuous, counters_.continuous);
    else
      act(Limit::peak, counters_.peak);
    return force / norm * ceiling_;
  }

  Scalar permitted() const noexcept {
    if (budget_.spent() <= full_until_) return cool_ * full_;  // the same as below, to the bit
    const Scalar share = std::min(Scalar(1), 2 * budget_.left());
    const Scalar wanted = steady_ + share * (max_force_ - steady_);
    return cool_ * std::min(wanted, std::sqrt(budget_.permitted_square(hold_, budget_.spent())));
  }

  /// Counts the force of the previous tick for the time that the device held it.
  void count(Scalar elapsed) noexcept {
    const bool known = elapsed >= 0 && std::isfinite(elapsed);
    // Before the first tick of a run no time has passed. A period of rest for each run would add up over many runs,
    // and so would a period of rest for each wrong time stamp.
    const bool no_time = !known && elapsed != unknown_time && held_square_ == 0;
    budget_.spend(held_square_, known ? elapsed : no_time ? 0 : period_);
    held_square_ = 0;
    limit_ = Limit::none;
  }

  void act(Limit limit, std::uint64_t& counter) noexcept {
    limit_ = limit;
    ++counter;
  }

  static constexpr Scalar smallest_square = std::numeric_limits<Scalar>::min() * 1000;  ///< N^2, far from denormal

  Scalar max_force_;   ///< N
  Scalar warm_motor_;  ///< 0 to 1
  BasicForceBudget<Scalar> budget_;
  Scalar period_;
  Scalar steady_;      ///< the largest constant force, N
  Scalar full_;        ///< the ceiling of cool motors with a full budget, N: max_force, but for rounding
  Scalar full_until_;  ///< the ceiling of cool motors is full_ while no more than this is spent, N^2 s; -1: never sure
  Scalar hold_, ramp_step_, cooling_step_;
  Scalar cool_ = 1;  ///< the factor by which warm motors reduce the ceiling, 0 to 1. 1 is no reduction
  Scalar gain_ = 0, ceiling_;
  Scalar held_square_ = 0;  ///< the square of the force that the device holds since the last tick, N^2
  Limit limit_ = Limit::none;
  LimitCounters counters_{};
};

using ForceLimiter = BasicForceLimiter<double>;
using ForceLimiterF = BasicForceLimiter<float>;

}  // namespace punctura
