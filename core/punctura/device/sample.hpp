// What a device reports in a tick.
#pragma once

#include <array>
#include <cstdint>

namespace punctura {

/// One reading. Axes: right-handed, x right, y up, z towards the user.
struct DeviceSample {
  std::uint64_t sequence;          ///< the device's own count of readings: the same number twice is the same reading
  double time;                     ///< when the tick began, s, on a clock that never goes back
  std::array<double, 3> position;  ///< of the needle's tip, m
  std::array<double, 3> axis;      ///< unit direction in which the needle points; not read with Direction::motion
  std::uint32_t buttons;           ///< one bit each
  bool healthy;                    ///< false: the back-end reports a fault of its own
  double motor_temperature =
      0;  ///< of the hottest motor, 0 to 1 where its maker sees danger; 0 where it is not reported
};

}  // namespace punctura
