// Force Dimension's axes and ours: theirs are x to the user, y right, z up; ours x right, y up, z to the user. Both are
// right-handed.
#pragma once

#include <array>

namespace punctura::force_dimension {

using Triple = std::array<double, 3>;

/// A position, a direction or a force of the device in Punctura's axes.
constexpr Triple to_ours(const Triple& device) noexcept { return {device[1], device[2], device[0]}; }

/// The inverse rotation.
constexpr Triple to_device(const Triple& ours) noexcept { return {ours[2], ours[0], ours[1]}; }

/// Rotates `tool` from the axes of the handle to those of the device. frame: rows of the handle's rotation matrix.
constexpr Triple turned(const double (&frame)[3][3], const Triple& tool) noexcept {
  Triple d{};
  for (int row = 0; row < 3; ++row)
    d[static_cast<unsigned>(row)] = frame[row][0] * tool[0] + frame[row][1] * tool[1] + frame[row][2] * tool[2];
  return d;
}

}  // namespace punctura::force_dimension
