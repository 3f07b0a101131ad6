// What leaves for the device is bounded here. Every bound that acts is counted and named.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "punctura/model/omni.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/safety/force_budget.hpp"

namespace punctura {

struct ForceLimits {
  double max_force = Omni::max_force;                ///< N, norm
  double continuous_force = Omni::continuous_force;  ///< N rms in any continuous_time
  double continuous_time = 10;  ///< s. A choice: no data sheet gives the motors' thermal time constant
  double ramp_time = 0.5;       ///< s from zero to full force after arming
  double warm_motor = 0.8;      ///< motor temperature (0 to 1) above which the ceiling comes down, to no force at 1
};

/// The limit that makes the force of a tick smaller than the model's.
enum class Limit : std::uint8_t {
  none,         ///< no limit acts: the whole force goes out, or none is asked for
  ramp,         ///< the force still grows after arming
  peak,         ///< max_force
  continuous,   ///< continuous_force: the budget is used up
  temperature,  ///< the device reports warm motors
};

/// How often each limit has acted, in ticks.
struct LimitCounters {
  std::uint64_t peak = 0, continuous = 0, temperature = 0, ramp = 0;
};

/// Clamp by norm (never per axis: that would turn the force), budget for continuous force, ramp in.
///
/// While more than half of the budget is left, the ceiling is max_force. Then it comes down evenly, to the force that may
/// be given without end. It comes up again only while the force is below that, so a force that a limit holds never rises
/// by itself. There is no limit on the rate of change: the pop is an intended step.
///
/// A device holds a force until the next tick, however late that comes. So each tick counts the force of the one before,
/// for the time that has passed.
template <typename Scalar>
class BasicForceLimiter {
 public:
  using Vector = Vector3<Scalar>;
  /// s. A force is held so long at most, by the gate's deadline; the budget always has room for that.
  static constexpr Scalar longest_hold = Scalar(0.020);
  static constexpr Scalar unknown_time = -1;

  BasicForceLimiter(const ForceLimits& limits, Scalar period) noexcept
      : max_force_(static_cast<Scalar>(limits.max_force)),
        warm_motor_(static_cast<Scalar>(limits.warm_motor)),
        budget_(static_cast<Scalar>(limits.continuous_time), static_cast<Scalar>(limits.continuous_force)),
        period_(period),
        steady_(std::min(max_force_, std::sqrt(budget_.rate()))),
        hold_(std::max(period, longest_hold)),
        ramp_step_(period / static_cast<Scalar>(limits.ramp_time)),
        ceiling_(permitted(0)) {}

  /// Starts a new ramp. The budget and the counters stay: motors do not cool by a reset.
  void reset() noexcept { gain_ = 0; }

  /// Goes on from where another limiter is, with its own limits: ramp, budget and counters.
  void resume(const BasicForceLimiter& previous) noexcept {
    gain_ = previous.gain_;
    held_square_ = previous.held_square_;
    counters_ = previous.counters_;
    budget_.set_spent(previous.budget_.spent());
  }

  /// One tick: the model's force (N, finite) gives the force for the device. motor_temperature: 0 to 1. elapsed: s since
  /// the tick before; a period if not given; NaN in the first tick of a run.
  Vector step(const Vector& wanted, Scalar motor_temperature = 0, Scalar elapsed = unknown_time) noexcept {
    count(elapsed);
    gain_ = std::min(Scalar(1), gain_ + ramp_step_);
    if (gain_ < 1 && wanted != Vector()) act(Limit::ramp, counters_.ramp);
    Vector force = gain_ * wanted;

    ceiling_ = permitted(motor_temperature);
    if (const Scalar norm = force.stableNorm(); !(norm <= ceiling_)) {
      force = force / norm * ceiling_;
      if (cool(motor_temperature) < 1)
        act(Limit::temperature, counters_.temperature);
      else if (ceiling_ < max_force_)
        act(Limit::continuous, counters_.continuous);
      else
        act(Limit::peak, counters_.peak);
    }
    held_square_ = force.squaredNorm();
    return force;
  }

  /// One tick without force.
  void rest(Scalar motor_temperature = 0, Scalar elapsed = unknown_time) noexcept {
    count(elapsed);
    ceiling_ = permitted(motor_temperature);
  }

  /// Ticks have ended: the device has held the last force for so long, s, and now gives none.
  void end(Scalar elapsed) noexcept { count(elapsed); }

  Scalar ceiling() const noexcept { return ceiling_; }  ///< the greatest force that the last tick permitted, N
  Limit limit() const noexcept { return limit_; }       ///< what cut the force of the last tick
  Scalar gain() const noexcept { return gain_; }        ///< of the ramp, 0 to 1
  const LimitCounters& counters() const noexcept { return counters_; }

  const BasicForceBudget<Scalar>& budget() const noexcept { return budget_; }
  /// Goes on with a device whose motors have given that much, N^2 s, see ForceBudget::spent.
  void set_spent(Scalar spent) noexcept { budget_.set_spent(spent); }

  static void archive(auto& self, auto& state) {
    BasicForceBudget<Scalar>::archive(self.budget_, state);
    state.numbers(self.gain_, self.ceiling_, self.held_square_);
    state.require(self.gain_ >= 0 && self.gain_ <= 1 && self.held_square_ >= 0);
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
  /// By how much warm motors bring the ceiling down: 1 is not at all.
  Scalar cool(Scalar temperature) const noexcept {
    if (temperature <= warm_motor_) return 1;
    return std::max(Scalar(0), (1 - temperature) / (1 - warm_motor_));
  }

  Scalar permitted(Scalar temperature) const noexcept {
    const Scalar share = std::min(Scalar(1), 2 * budget_.left());
    const Scalar wanted = steady_ + share * (max_force_ - steady_);
    return cool(temperature) * std::min(wanted, std::sqrt(budget_.permitted_square(hold_)));
  }

  /// The force of the tick before, for the time that it was held.
  void count(Scalar elapsed) noexcept {
    const bool known = elapsed >= 0 && std::isfinite(elapsed);
    // Before the first tick of a run no time has passed: a period of rest for each run would add up over many runs.
    // So would one for each wrong stamp.
    const bool no_time = !known && elapsed != unknown_time && held_square_ == 0;
    budget_.spend(held_square_, known ? elapsed : no_time ? 0 : period_);
    held_square_ = 0;
    limit_ = Limit::none;
  }

  void act(Limit limit, std::uint64_t& counter) noexcept {
    limit_ = limit;
    ++counter;
  }

  Scalar max_force_;   ///< N
  Scalar warm_motor_;  ///< 0 to 1
  BasicForceBudget<Scalar> budget_;
  Scalar period_;
  Scalar steady_;  ///< the force that may be given without end, N
  Scalar hold_, ramp_step_;
  Scalar gain_ = 0, ceiling_;
  Scalar held_square_ = 0;  ///< of the force that the device holds since the last tick, N^2
  Limit limit_ = Limit::none;
  LimitCounters counters_{};
};

using ForceLimiter = BasicForceLimiter<double>;
using ForceLimiterF = BasicForceLimiter<float>;

}  // namespace punctura
