// The interface of a haptic device: a class with virtual functions, one for each kind of device.
#pragma once

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "punctura/device/sample.hpp"
#include "punctura/model/field.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// The properties of a device, as it reports them. A number is NaN if the device does not report it.
struct DeviceInfo {
  std::string backend, model, serial;
  bool has_orientation = false;
  unsigned button_count = 0;
  double max_force = not_given;         ///< N, for a short time
  double continuous_force = not_given;  ///< N, for any time
  double max_stiffness = not_given;     ///< N/m
  double encoder_step = not_given;      ///< m
  double rate = not_given;              ///< Hz, ticks per second, measured or set when the device was opened
};

/// The longest times without a tick, s, before a loop ends the run: until then the device holds its last force.
struct LongestSilence {
  double at_start = 0.1;  ///< before the first tick
  double later = 0.1;
  /// Nobody holds the device, or it does not follow the clock.
  static constexpr LongestSilence any() noexcept {
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
};

/// A device cannot be opened or started. The text says what is wrong and what to do.
class DeviceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How much force the motors of a device have given recently. It outlasts a run, because the motors stay warm.
struct MotorUse {
  double spent = 0;         ///< N^2 s, see ForceBudget::spent
  double time = not_given;  ///< s, when the loop stopped, on its clock; NaN: no time counts as rest
};

/// The callback of a device. The device calls it once per reading. It returns the force for the device, N.
///
/// It never throws and never waits. It is the last guard before every motor: a force that is not finite becomes zero,
/// and one above max_force is shortened. Without a limit (NaN, negative) there is no force. A back-end needs no guard
/// of its own.
struct Tick {
  using Force = std::array<double, 3>;
  Force (*call)(void* context, const DeviceSample& sample) noexcept;
  void* context;
  double max_force;  ///< N, norm, in the axes of the device

  Force operator()(const DeviceSample& sample) const noexcept {
    const Vector3d force = to_vector(call(context, sample));
    if (!force.allFinite() || !(max_force >= 0)) return {0, 0, 0};
    if (force.squaredNorm() <= max_force * max_force) return to_array(force);
    return to_array(max_force / force.stableNorm() * force);
  }
};

/// An open device. It determines when a tick runs: the device calls the callback.
///
/// The reason: some drivers call back at their own rate, some answer requests, and some can be read at any time.
///
/// Samples and forces have the axes and units of Punctura. The back-end converts them.
class Device {
 public:
  virtual ~Device() = default;

  /// The properties of the device. `info().rate` is the rate of its ticks.
  virtual const DeviceInfo& info() const noexcept = 0;

  /// Starts the ticks. They run on a thread of the device until stop(). Throws DeviceError, also if ticks run already.
  virtual void start(Tick tick) = 0;

  /// Sets the force to zero and ends the ticks. When it returns, both are done. It may be called at any time, also
  /// twice.
  virtual void stop() noexcept = 0;

  virtual LongestSilence longest_silence() const noexcept { return {}; }
  virtual bool finished() const noexcept { return false; }  ///< ticks have ended, without stop()

  /// Describes the problem if samples have healthy = false or if ticks have stopped. Otherwise empty.
  virtual std::string trouble() const { return {}; }

  /// Facts for the user about how the device runs: granted and refused priorities, rates, labels. Valid after start().
  virtual std::vector<std::string> statements() const { return {}; }

  /// Kept for the servo loops that run on the device, one after the other. They synchronize the access to it.
  MotorUse motor_use{};
};

}  // namespace punctura
