// The ratings of a device, and what its motors have given, from one run to the next.
#pragma once

#include <mutex>

#include "punctura/device/device.hpp"
#include "punctura/safety/force_limits.hpp"

namespace punctura {

namespace detail {
/// Guards `motor_use` of all devices.
inline std::mutex& motor_use_mutex() {
  static std::mutex mutex;
  return mutex;
}
}  // namespace detail

/// The limits, not above the device's ratings. A rating that the device does not know is NaN: it lowers none.
inline ForceLimits tightened(ForceLimits limits, const DeviceInfo& info) noexcept {
  if (info.max_force < limits.max_force) limits.max_force = info.max_force;
  if (info.continuous_force < limits.continuous_force) limits.continuous_force = info.continuous_force;
  return limits;
}

/// The force budget that the motors have spent by `now` (s), N^2 s. The time since their last run counts as rest.
inline double rested(Device& device, const ForceLimits& limits, double now) {
  const std::lock_guard lock(detail::motor_use_mutex());
  MotorUse& motors = device.motor_use;
  ForceBudget budget(limits.continuous_time, limits.continuous_force);
  budget.set_spent(motors.spent);
  if (motors.time <= now) budget.spend(0, now - motors.time);
  motors = {budget.spent(), now};
  return motors.spent;
}

/// The device goes on with what the motors of another object for the same physical device have spent.
inline void go_on_from(const Device& previous, Device& device) {
  const std::lock_guard lock(detail::motor_use_mutex());
  device.motor_use = previous.motor_use;
}

/// What keep_spent(), rested() or go_on_from() kept last, N^2 s.
inline double kept_spent(const Device& device) {
  const std::lock_guard lock(detail::motor_use_mutex());
  return device.motor_use.spent;
}

/// Keeps what the motors have spent (N^2 s) at the end of a run, at `now` (s). If `now` is unknown, no time counts as
/// rest.
inline void keep_spent(Device& device, double spent, double now) {
  const std::lock_guard lock(detail::motor_use_mutex());
  device.motor_use = {spent, now};
}

}  // namespace punctura
