// The messages of the Inverse Service, and those to it.
#pragma once

#include <array>
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

}  // namespace punctura::haply
