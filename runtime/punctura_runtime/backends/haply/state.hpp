// What the Inverse Service says of its devices, and what it is told.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace punctura::haply {

/// A name that came in a message, kept without taking memory. Longer ones, and ones with an escape or a blank, are not kept.
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
  std::optional<Vector> force;     ///< N, that the service says it gives out
  std::optional<bool> calibrated, in_use, power_supply, ready;
};

/// A VerseGrip in the hand, wired or wireless.
struct Grip {
  Name id;
  std::optional<Quaternion> orientation;
  std::uint32_t buttons = 0;  ///< a, b, c, or the only one, as bits 0, 1, 2
  bool connected = true;
};

/// One message of the service, as far as we use it. Every field of it may be missing.
struct State {
  std::array<Arm, 8> arms;
  std::size_t arm_count = 0;  ///< how many of them are there; more than eight are passed over
  Grip grip;                  ///< the first that is connected and has an orientation
  bool has_grip = false;

  const Arm* find(
      std::string_view id) const noexcept;  ///< the first of all where id is empty; nullptr when it is not there
};

/// False when the text is not JSON, or no object. `state` is overwritten.
bool read_state(std::string_view text, State& state) noexcept;

/// The two names of the vector in set_cursor_force: `vector` from version 3.5 of the service on, `values` before it.
enum class ForceKey : std::uint8_t { vector, values };
constexpr std::string_view name(ForceKey key) noexcept { return key == ForceKey::vector ? "vector" : "values"; }

/// The command of a tick into `out`, which has 512 bytes or more. force: N, finite, in the service's axes. Gives its size.
std::size_t write_force(std::string_view id, ForceKey key, const Vector& force, std::span<char> out) noexcept;

}  // namespace punctura::haply
