// The reading of a device in a tick.
#pragma once

#include <array>
#include <cstdint>

namespace punctura {

/// One reading of a device. Axes: right-handed, x right, y up, z towards the user.
///
/// A number that is not finite is a fault (input_gate.hpp). A device without a sensor leaves the default.
struct DeviceSample {
  std::uint64_t sequence;  ///< number of the reading, counted by the device; an equal number is the same reading
  double time;  ///< start of the tick, s, on a clock that never goes back, and goes on while the computer sleeps
  std::array<double, 3> position;  ///< of the needle's tip, m
  std::array<double, 3> axis;      ///< unit direction of the needle; not read with Direction::motion
  std::uint32_t buttons;           ///< one bit for each button
  bool healthy;                    ///< false: the back-end reports a fault
  double motor_temperature = 0;    ///< of the hottest motor: 1 is the maker's danger limit; 0 if it is not reported
  double thumb = 0;                ///< depth of the thumb on the syringe's plunger, m, from where the plunger starts;
                                   ///< NaN: the thumb's device has a fault
  double thumb_felt = 0;           ///< force that the thumb's device gave last, after its limits, N; 0 without one
};

}  // namespace punctura
