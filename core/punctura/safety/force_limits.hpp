// The limits on the force for the device. Each limit that acts is counted and reported.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

#include "punctura/model/omni.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/safety/force_budget.hpp"
#include "punctura/safety/input_gate.hpp"

namespace punctura {

/// The limits on the force that a device gets. check(gate, limits) finds values that would disable safety.
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
template <>
inline constexpr std::array<std::string_view, 5> words_of<Limit>{"none", "ramp", "peak", "continuous", "temperature"};

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
/// In lanes, each lane has a limiter. Lanes do not tell the limits apart, and count nothing.
template <typename Scalar>
class BasicForceLimiter {
 public:
  using Vector = Vector3<Scalar>;
  using Truth = Mask<Scalar>;
  using Acting = std::conditional_t<OneNumber<Scalar>, Limit, Truth>;  ///< in lanes: whether a limit acts
  /// The budget always has room for a device that holds a force for this time, s: the ordinary deadline of the gate.
  /// A longer deadline can exceed the continuous force (docs/safety.md).
  static constexpr auto longest_hold = static_cast<Lane<Scalar>>(GateLimits{}.deadline);
  static constexpr Lane<Scalar> unknown_time = -1;  ///< `elapsed` of a tick whose time is not known: one period counts

  /// What it remembers beside the budget: the ramp, the motors' temperature, the force that the device holds. A limiter
  /// with the state of another one goes on, with its own limits.
  struct State {
    Scalar gain{0};         ///< of the ramp
    Scalar cool{1};         ///< the factor by which warm motors reduce the ceiling, 0 to 1. 1 is no reduction
    Scalar held_square{0};  ///< the square of the force that the device holds since the last tick, N^2
    LimitCounters counters{};
  };
  State state{};

  constexpr BasicForceLimiter(const ForceLimits& limits, const Scalar& period) noexcept
      : max_force_(static_cast<Scalar>(limits.max_force)),
        warm_motor_(static_cast<Scalar>(limits.warm_motor)),
        budget_(static_cast<Scalar>(limits.continuous_time), static_cast<Scalar>(limits.continuous_force)),
        period_(period),
        ramp_step_(period / static_cast<Scalar>(limits.ramp_time)),
        cooling_step_(period / static_cast<Scalar>(limits.continuous_time)) {
    using namespace lane;
    steady_ = min(max_force_, sqrt(budget_.rate()));
    full_ = steady_ + (max_force_ - steady_);
    hold_ = max(period, Scalar(longest_hold));
    // Up to half of the budget the share in permitted() is 1, and there is the least room for a hold at the half.
    const Scalar half = budget_.depth() / 2;
    const Scalar square = full_ * full_;
    full_until_ = select(square > smallest_square && budget_.permitted_square(hold_, half) >= square, half, Scalar(-1));
    ceiling_ = permitted();
  }

  /// Starts a new ramp. The budget and the counters stay, because motors do not cool by a reset.
  constexpr void reset(const Truth& lanes = Truth(true)) noexcept {
    using namespace lane;
    state.gain = select(lanes, Scalar(0), state.gain);
  }
  /// Forgets its state in these lanes.
  constexpr void restart(const Truth& lanes) noexcept {
    using namespace lane;
    reset(lanes);
    state.cool = select(lanes, Scalar(1), state.cool);
    state.held_square = select(lanes, Scalar(0), state.held_square);
  }

  /// One tick. wanted: the force of the model times the force scale, N, finite. Returns the force for the device, N.
  /// motor_temperature: 0 to 1. elapsed: s since the previous tick; NaN in the first tick of a run; a period if it is
  /// left out.
  constexpr Vector step(const Vector& wanted, const Scalar& motor_temperature = Scalar(0),
                        const Scalar& elapsed = Scalar(unknown_time)) noexcept {
    using namespace lane;
    count(elapsed);
    state.gain = min(Scalar(1), Scalar(state.gain + ramp_step_));
    Vector force = wanted;
    if (const Truth rises = state.gain < 1; any(rises)) {
      act(Limit::ramp, rises && !wanted.isZero());
      force = state.gain * wanted;
    }

    feel(motor_temperature);
    ceiling_ = permitted();
    state.held_square = force.squaredNorm();
    // Most forces are far enough below the ceiling that rounding cannot matter. They need no root. Denormal squares are
    // too coarse for this comparison.
    const Scalar below = Lane<Scalar>(0.999) * ceiling_ * ceiling_;
    const Truth close = !(state.held_square < below && below > smallest_square);
    if (any(close)) {
      force = clamped(force, close);
      state.held_square = force.squaredNorm();
    }
    return force;
  }

  /// One tick without force. motor_temperature: 0 to 1. elapsed: s since the previous tick, as in step().
  constexpr void rest(const Scalar& motor_temperature = Scalar(0),
                      const Scalar& elapsed = Scalar(unknown_time)) noexcept {
    count(elapsed);
    feel(motor_temperature);
    ceiling_ = permitted();
  }

  /// Ends a run. The device has held the last force for `elapsed` (s) and now gives no force.
  constexpr void end(const Scalar& elapsed) noexcept { count(elapsed); }

  constexpr Scalar ceiling() const noexcept { return ceiling_; }  ///< the largest force that the last tick permitted, N
  constexpr Acting limit() const noexcept { return limit_; }      ///< the limit that reduced the force of the last tick
  constexpr Scalar gain() const noexcept { return state.gain; }   ///< gain of the ramp, 0 to 1
  constexpr const LimitCounters& counters() const noexcept { return state.counters; }

  constexpr const BasicForceBudget<Scalar>& budget() const noexcept { return budget_; }
  /// Sets how much the motors of the device have given before, N^2 s. See ForceBudget::spent.
  constexpr void set_spent(const Scalar& spent) noexcept { budget_.set_spent(spent); }

  static void archive(auto& self, auto& state) {
    auto& own = self.state;
    state.fields(self.budget_, own.gain, own.cool, self.ceiling_, own.held_square);
    state.require(own.gain >= 0 && own.gain <= 1 && own.cool >= 0 && own.cool <= 1 && own.held_square >= 0);
    state.choice(self.limit_, Limit::temperature);
    auto& acted = own.counters;
    state.fields(acted.peak, acted.continuous, acted.temperature, acted.ramp);
  }
  void describe(auto& parameters) const {
    budget_.describe(parameters);
    parameters.fields(max_force_, warm_motor_, period_, steady_, hold_, ramp_step_);
  }

 private:
  /// Warm motors reduce the ceiling at once. It returns slowly, so that a sensor that fails now and then cannot switch
  /// the force on and off. NaN reduces it to 0.
  constexpr void feel(const Scalar& temperature) noexcept {
    using namespace lane;
    const Scalar cooler = min(Scalar(1), Scalar(state.cool + cooling_step_));
    const Truth cold = temperature <= warm_motor_;
    state.cool = cooler;
    if (!all(cold))
      state.cool = select(cold, cooler, min(cooler, max(Scalar(0), Scalar((1 - temperature) / (1 - warm_motor_)))));
  }

  /// A force whose norm is at most the ceiling, with the direction of `force`. close: where it may be larger.
  constexpr Vector clamped(const Vector& force, const Truth& close) noexcept {
    using namespace lane;
    const Scalar norm = force.stableNorm();
    const Truth over = close && !(norm <= ceiling_), warm = state.cool < 1, spent = ceiling_ < max_force_;
    act(Limit::temperature, over && warm);
    act(Limit::continuous, over && !warm && spent);
    act(Limit::peak, over && !warm && !spent);
    return select(over, Vector(force / norm * ceiling_), force);
  }

  constexpr Scalar permitted() const noexcept {
    using namespace lane;
    if (all(budget_.spent() <= full_until_)) return state.cool * full_;  // the same as below, to the bit
    const Scalar share = min(Scalar(1), Scalar(2 * budget_.left()));
    const Scalar wanted = steady_ + share * (max_force_ - steady_);
    return state.cool * min(wanted, sqrt(budget_.permitted_square(hold_, budget_.spent())));
  }

  /// Counts the force of the previous tick for the time that the device held it.
  constexpr void count(const Scalar& elapsed) noexcept {
    using namespace lane;
    const Truth known = elapsed >= 0 && elapsed <= std::numeric_limits<Lane<Scalar>>::max();
    Scalar time = elapsed;
    if (!all(known)) {
      // Before the first tick of a run no time has passed. A period of rest for each run would add up over many runs,
      // and so would a period of rest for each wrong time stamp.
      const Truth no_time = !known && !(elapsed == unknown_time) && state.held_square == 0;
      time = select(known, elapsed, select(no_time, Scalar(0), period_));
    }
    budget_.spend(state.held_square, time);
    state.held_square = Scalar(0);
    limit_ = {};
  }

  /// where: whether this limit acts.
  constexpr void act(Limit limit, const Truth& where) noexcept {
    if constexpr (Lanes<Scalar>) {
      limit_ = limit_ || where;
    } else if (where) {
      using All = LimitCounters;
      constexpr std::uint64_t All::* of[] = {nullptr, &All::ramp, &All::peak, &All::continuous, &All::temperature};
      limit_ = limit;
      ++(state.counters.*of[static_cast<std::size_t>(limit)]);
    }
  }

  static constexpr auto smallest_square = std::numeric_limits<Lane<Scalar>>::min() * 1000;  ///< N^2, far from denormal

  Scalar max_force_;   ///< N
  Scalar warm_motor_;  ///< 0 to 1
  BasicForceBudget<Scalar> budget_;
  Scalar period_;
  Scalar steady_;      ///< the largest constant force, N
  Scalar full_;        ///< the ceiling of cool motors with a full budget, N: max_force, but for rounding
  Scalar full_until_;  ///< the ceiling of cool motors is full_ while no more than this is spent, N^2 s; -1: never sure
  Scalar hold_, ramp_step_, cooling_step_;
  Scalar ceiling_;
  Acting limit_{};
};

using ForceLimiter = BasicForceLimiter<double>;
using ForceLimiterF = BasicForceLimiter<float>;

}  // namespace punctura
