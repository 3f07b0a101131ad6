// What every haptic device is to the servo loop: the one interface with inheritance.
#pragma once

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "punctura/device/sample.hpp"

namespace punctura {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What a device says of itself. NaN where it does not say.
struct DeviceInfo {
  std::string backend, model, serial;
  bool has_orientation = false;
  unsigned button_count = 0;
  double max_force = unknown;         ///< N, for a moment
  double continuous_force = unknown;  ///< N, for ever
  double max_stiffness = unknown;     ///< N/m
  double encoder_step = unknown;      ///< m
  double rate = unknown;              ///< ticks a second, as measured or set when it was opened, Hz
};

/// A device that cannot be opened or started: what is wrong, and what to do.
class DeviceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the motors of a device have given lately: runs come and go, and the motors stay warm.
struct MotorUse {
  double spent = 0;       ///< N^2 s, see ForceBudget::spent
  double time = unknown;  ///< s, on the clock of the loop that was stopped then; NaN: no time counts as rest
};

/// What a device calls once per reading: a reading in, the force for the device out (N). It never throws and never waits.
struct Tick {
  using Force = std::array<double, 3>;
  Force (*call)(void* context, const DeviceSample& sample) noexcept;
  void* context;

  Force operator()(const DeviceSample& sample) const noexcept { return call(context, sample); }
};

/// An open device. It owns its clock: some makers' drivers call back at their own rate, some answer a request with a reading, some
/// are read whenever we like. So the device calls the tick, and not the tick the device.
///
/// Samples come, and forces go, in Punctura's axes and units whatever the maker's are.
class Device {
 public:
  virtual ~Device() = default;

  /// `info().rate` is the rate at which ticks will come.
  virtual const DeviceInfo& info() const noexcept = 0;

  /// Ticks come from now on, on a thread of the device's, until stop(). Throws DeviceError, also where it ticks already.
  virtual void start(Tick tick) = 0;

  /// Zero force, then no tick any more; both hold when it returns. Safe to call at any time, and twice.
  virtual void stop() noexcept = 0;

  /// What went wrong, in words, when samples come with healthy = false, or ticks have ceased; empty otherwise.
  virtual std::string trouble() const { return {}; }

  /// What its user should know of how it runs: priorities granted and refused, rates, labels. Valid after start().
  virtual std::vector<std::string> statements() const { return {}; }

  /// Of the loops that run on the device, one after the other. They guard it.
  MotorUse motor_use{};
};

}  // namespace punctura
