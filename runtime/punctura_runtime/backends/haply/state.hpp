// The messages of the Inverse Service, those to it, and its axes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace punctura::haply {

/// A device_id, stored without allocation. Empty for names that are longer or have an escape or a blank.
class Name {
 public:
  Name() = default;
  explicit Name(std::string_view text) noexcept;
  std::string_view view() const noexcept { return {text_.data(), size_}; }
  bool empty() const noexcept { return size_ == 0; }

 private:
  std::array<char, 64> text_{};
  std::size_t size_ = 0;
};

using Vector = std::array<double, 3>;      ///< x, y, z in the service's axes
using Quaternion = std::array<double, 4>;  ///< w, x, y, z

/// One Inverse3.
struct Arm {
  Name id;
  std::optional<Vector> position;  ///< m
  std::optional<Vector> force;     ///< N, as the service reports it
  std::optional<bool> calibrated, in_use, power_supply, ready;
};

/// A VerseGrip, wired or wireless.
struct Grip {
  Name id;
  std::optional<Quaternion> orientation;
  std::uint32_t buttons = 0;  ///< bits 0, 1, 2: buttons a, b, c; bit 0: the only button
  bool connected = true;
};

/// The used parts of a message of the service. Every field may be missing.
struct State {
  std::array<Arm, 8> arms;
  std::size_t arm_count = 0;  ///< more than eight are ignored
  Grip grip;                  ///< the first that is connected and has an orientation
  bool has_grip = false;

  const Arm* find(std::string_view id) const noexcept;  ///< the first if id is empty; nullptr if there is none
};

/// False if the text is not JSON or not an object. Overwrites `state`.
bool read_state(std::string_view text, State& state) noexcept;

/// The key of the vector in set_cursor_force: `vector` from version 3.5 of the service on, `values` before.
enum class ForceKey : std::uint8_t { vector, values };
constexpr std::string_view name(ForceKey key) noexcept { return key == ForceKey::vector ? "vector" : "values"; }

/// Writes the command of a tick into `out`, which has 512 bytes or more. force: N, finite, in the service's axes.
/// Returns the size.
std::size_t write_force(std::string_view id, ForceKey key, const Vector& force, std::span<char> out) noexcept;

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
