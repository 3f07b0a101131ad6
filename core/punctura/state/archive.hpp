// States as bytes: to keep one, to send it to another process, to go on from it to the same bits.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "punctura/model/vector3.hpp"

namespace punctura {

/// Writes a state field by field, in this machine's byte order.
///
/// A class with state has `template <typename Archive> void archive(Archive&)`, which names its fields once, for both directions.
class StateWriter {
 public:
  static constexpr bool reading = false;
  explicit StateWriter(std::vector<std::byte>& to) : to_(to) {}

  template <std::floating_point Scalar>
  void number(const Scalar& value) {
    put(&value, sizeof value);
  }
  template <typename Scalar>
  void number(const Vector3<Scalar>& value) {
    put(value.data(), 3 * sizeof(Scalar));
  }
  void flag(const bool& value) { index(value ? 1u : 0u, 2); }
  /// A whole number below `limit`.
  template <std::unsigned_integral Index>
  void index(const Index& value, std::uint64_t) {
    const std::uint64_t wide = value;
    put(&wide, sizeof wide);
  }
  /// An enumerator up to `last`.
  template <typename Enum>
    requires std::is_enum_v<Enum>
  void choice(const Enum& value, Enum) {
    index(static_cast<std::uint64_t>(value), 0);
  }
  /// Whatever a law or a coupling of one's own remembers.
  template <typename Memory>
    requires std::is_trivially_copyable_v<Memory>
  void memory(const Memory& value) {
    if constexpr (!std::is_empty_v<Memory>) put(&value, sizeof value);
  }

 private:
  void put(const void* from, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(from);
    to_.insert(to_.end(), bytes, bytes + size);
  }

  std::vector<std::byte>& to_;
};

/// Reads what StateWriter has written. Bytes that no state can have make it not good().
class StateReader {
 public:
  static constexpr bool reading = true;
  explicit StateReader(std::span<const std::byte> from) noexcept : from_(from) {}

  /// Whether all bytes were read, none was missing, and each was what a state can have.
  bool good() const noexcept { return good_ && from_.empty(); }

  template <std::floating_point Scalar>
  void number(Scalar& value) noexcept {
    take(&value, sizeof value);
    good_ = good_ && std::isfinite(value);
  }
  template <typename Scalar>
  void number(Vector3<Scalar>& value) noexcept {
    for (Scalar& component : value) number(component);
  }
  void flag(bool& value) noexcept {
    std::uint64_t wide = 0;
    index(wide, 2);
    value = wide == 1;
  }
  template <std::unsigned_integral Index>
  void index(Index& value, std::uint64_t limit) noexcept {
    std::uint64_t wide = 0;
    take(&wide, sizeof wide);
    good_ = good_ && wide < limit;
    value = good_ ? static_cast<Index>(wide) : Index{0};
  }
  template <typename Enum>
    requires std::is_enum_v<Enum>
  void choice(Enum& value, Enum last) noexcept {
    std::uint64_t wide = 0;
    index(wide, static_cast<std::uint64_t>(last) + 1);
    value = static_cast<Enum>(wide);
  }
  template <typename Memory>
    requires std::is_trivially_copyable_v<Memory>
  void memory(Memory& value) noexcept {
    if constexpr (!std::is_empty_v<Memory>) take(&value, sizeof value);
  }

 private:
  void take(void* to, std::size_t size) noexcept {
    good_ = good_ && from_.size() >= size;
    if (!good_) return;
    std::memcpy(to, from_.data(), size);
    from_ = from_.subspan(size);
  }

  std::span<const std::byte> from_;
  bool good_ = true;
};

/// Stands in front of every state. Raised when a class with state writes other fields.
inline constexpr std::uint64_t state_format = 1;

/// All that the next tick depends on, as bytes.
template <typename T>
std::vector<std::byte> save_state(const T& object) {
  std::vector<std::byte> bytes;
  StateWriter writer(bytes);
  writer.index(state_format, 0);
  const_cast<T&>(object).archive(writer);  // a writer changes nothing
  return bytes;
}

/// Goes on from bytes that save_state() gave for an object of the same parameters. Returns false, and leaves the object as it was, where
/// they are not that.
template <typename T>
bool load_state(T& object, std::span<const std::byte> bytes) {
  T loaded = object;
  StateReader reader(bytes);
  std::uint64_t format = 0;
  reader.index(format, state_format + 1);
  loaded.archive(reader);
  if (!reader.good() || format != state_format) return false;
  object = std::move(loaded);
  return true;
}

}  // namespace punctura
