// What leaves for the device is bounded here, and every bound that acts is counted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "punctura/model/vector3.hpp"

namespace punctura {

struct ForceLimits {
  double max_force = 3.3;          ///< N, norm. A PHANTOM Omni's peak, by its maker's data sheet
  double continuous_force = 0.88;  ///< N rms over continuous_time. The Omni's rating, by its maker's data sheet
  double continuous_time = 10;     ///< s. A choice: no data sheet gives the motors' thermal time constant
  double ramp_time = 0.5;          ///< s from zero to full force after arming
  double warm_motor = 0.8;         ///< motor temperature (0 to 1) above which the ceiling comes down, to no force at 1
};

/// How often each limit has acted, in ticks.
struct LimitCounters {
  std::uint64_t peak = 0, continuous = 0, temperature = 0, ramp = 0;
};

/// Clamp by norm (never per axis: that would turn the force), budget for continuous force, ramp in.
///
/// The budget is the mean square of the force given out, averaged exponentially over continuous_time. From 80 % of the
/// permitted mean square on, the ceiling goes from max_force down to continuous_force, which it reaches at 100 %: the mean
/// can never exceed the rating, and the ceiling moves over seconds. There is no limit on the rate of change: the pop is
/// an intended step.
class ForceLimiter {
 public:
  ForceLimiter(const ForceLimits& limits, double period) noexcept
      : limits_(limits), forget_(std::exp(-period / limits.continuous_time)), ramp_step_(period / limits.ramp_time) {}

  /// Starts a new ramp. The budget and the counters stay: motors do not cool by a reset.
  void reset() noexcept { gain_ = 0; }

  /// Goes on from where another limiter is, with its own limits: ramp, budget and counters.
  void resume(const ForceLimiter& previous) noexcept {
    gain_ = previous.gain_;
    mean_square_ = previous.mean_square_;
    counters_ = previous.counters_;
  }

  /// One tick: the model's force (N, finite) gives the force for the device. motor_temperature: 0 to 1.
  Vector3d step(const Vector3d& wanted, double motor_temperature = 0) noexcept {
    gain_ = std::min(1.0, gain_ + ramp_step_);
    if (gain_ < 1) ++counters_.ramp;
    Vector3d force = gain_ * wanted;

    const double cool =
        motor_temperature <= limits_.warm_motor ? 1 : std::max(0.0, (1 - motor_temperature) / (1 - limits_.warm_motor));
    const double norm = force.norm(), ceiling = cool * this->ceiling();
    if (norm > ceiling) {
      force *= ceiling / norm;
      ++(cool < 1 ? counters_.temperature : ceiling < limits_.max_force ? counters_.continuous : counters_.peak);
    }
    spend(force.squaredNorm());
    return force;
  }

  /// One tick without force.
  void rest() noexcept { spend(0); }

  double ceiling() const noexcept {
    const double permitted = limits_.continuous_force * limits_.continuous_force;
    const double used = std::clamp((mean_square_ / permitted - 0.8) / 0.2, 0.0, 1.0);
    const double floor = std::min(limits_.continuous_force, limits_.max_force);
    return limits_.max_force + used * (floor - limits_.max_force);
  }
  double gain() const noexcept { return gain_; }
  const LimitCounters& counters() const noexcept { return counters_; }

 private:
  void spend(double square) noexcept { mean_square_ = forget_ * mean_square_ + (1 - forget_) * square; }

  ForceLimits limits_;
  double forget_, ramp_step_;
  double gain_ = 0, mean_square_ = 0;
  LimitCounters counters_{};
};

}  // namespace punctura
