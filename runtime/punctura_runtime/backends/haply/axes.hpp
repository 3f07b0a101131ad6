// The Inverse3's axes (x right, y away from the user, z up) and Punctura's (x right, y up, z towards the user).
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "punctura_runtime/backends/haply/state.hpp"

namespace punctura::haply {

/// A proper rotation: its transpose converts forces back.
constexpr std::array<double, 3> ours(const Vector& v) noexcept { return {v[0], v[2], -v[1]}; }
constexpr Vector theirs(const std::array<double, 3>& v) noexcept { return {v[0], -v[2], v[1]}; }

/// The direction of a grip, R(q) (+Y), as a unit vector in Punctura's axes; nothing if q is not a rotation.
inline std::optional<std::array<double, 3>> pointing(const Quaternion& q) noexcept {
  const double norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(norm2 > 1e-6) || !std::isfinite(norm2)) return {};
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const Vector along{2 * (x * y - w * z) / norm2, 1 - 2 * (x * x + z * z) / norm2, 2 * (y * z + w * x) / norm2};
  return ours(along);
}

}  // namespace punctura::haply
