// States as bytes: save a state, send it to another process, continue from it with the same bits.
//
// These functions allocate memory. Do not call them in a tick.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace punctura {

/// What StateWriter and StateReader have in common.
template <typename State>
class StateFields {
 public:
  /// Numbers, vectors, truth values, whole numbers, objects with an archive, and arrays of all these, in this order.
  void fields(auto&&... all) { (field(all), ...); }

 private:
  template <typename Field>
  void field(Field& one) {
    using Plain = std::remove_const_t<Field>;
    State& state = static_cast<State&>(*this);
    if constexpr (std::is_empty_v<Plain>)
      return;  // no memory
    else if constexpr (requires { Plain::archive(one, state); })
      Plain::archive(one, state);
    else if constexpr (std::is_same_v<Plain, bool>)
      state.flag(one);
    else if constexpr (std::unsigned_integral<Plain>)
      state.index(one, std::numeric_limits<Plain>::max());
    else if constexpr (std::floating_point<Plain>)
      state.number(one);
    else
      for (auto& element : one) field(element);
  }
};

/// Writes a state field by field, in the byte order of this machine.
///
/// A class with state lists its fields in `static void archive(auto& self, auto& state)`, for writing and for
/// reading. It lists its parameters in `void describe(auto& parameters) const`. The memory of your own law or
/// coupling also needs an `archive`.
class StateWriter : public StateFields<StateWriter> {
 public:
  static constexpr bool reading = false;
  explicit StateWriter(std::vector<std::byte>& to) : to_(to) {}

  template <std::floating_point Scalar>
  void number(Scalar value) {
    bytes(&value, sizeof value);
  }
  void flag(bool value) { index(value ? 1u : 0u, 2); }
  /// A whole number below `limit`.
  template <std::unsigned_integral Index>
  void index(Index value, std::uint64_t) {
    const std::uint64_t wide = value;
    bytes(&wide, sizeof wide);
  }
  /// An enumerator, at most `last`.
  template <typename Enum>
  void choice(Enum value, Enum) {
    index(static_cast<std::uint64_t>(value), 0);
  }
  void require(bool) const noexcept {}

 private:
  void bytes(const void* from, std::size_t size) {
    const auto* data = static_cast<const std::byte*>(from);
    to_.insert(to_.end(), data, data + size);
  }

  std::vector<std::byte>& to_;
};

/// Reads a state that StateWriter has written. If a value is impossible in a state, good() becomes false.
class StateReader : public StateFields<StateReader> {
 public:
  static constexpr bool reading = true;
  explicit StateReader(std::span<const std::byte> from) noexcept : from_(from) {}

  /// Whether all bytes were read, no byte was missing and all values are possible in a state.
  bool good() const noexcept { return good_ && from_.empty(); }

  template <std::floating_point Scalar>
  void number(Scalar& value) noexcept {
    bytes(&value, sizeof value);
    require(std::isfinite(value));
  }
  void flag(bool& value) noexcept {
    std::uint64_t wide = 0;
    index(wide, 2);
    value = wide == 1;
  }
  template <std::unsigned_integral Index>
  void index(Index& value, std::uint64_t limit) noexcept {
    std::uint64_t wide = 0;
    bytes(&wide, sizeof wide);
    require(wide < limit);
    value = good_ ? static_cast<Index>(wide) : Index{0};
  }
  template <typename Enum>
  void choice(Enum& value, Enum last) noexcept {
    std::uint64_t wide = 0;
    index(wide, static_cast<std::uint64_t>(last) + 1);
    value = static_cast<Enum>(wide);
  }
  /// Checks a condition that every state fulfils.
  void require(bool holds) noexcept { good_ = good_ && holds; }

 private:
  void bytes(void* to, std::size_t size) noexcept {
    require(from_.size() >= size);
    if (!good_) return;
    std::memcpy(to, from_.data(), size);
    from_ = from_.subspan(size);
  }

  std::span<const std::byte> from_;
  bool good_ = true;
};

/// Writes or reads a number that may be NaN.
void archive_or_nan(auto& value, auto& state) {
  bool known = !std::isnan(value);
  auto stored = known ? value : 0;
  state.flag(known);
  state.fields(stored);
  if constexpr (std::remove_reference_t<decltype(state)>::reading)
    value = known ? stored : std::numeric_limits<double>::quiet_NaN();
}

/// The header of the bytes of a state.
struct StateHeader {
  std::uint64_t format = 6;      ///< increased when the fields of a class, or their order, change
  std::uint64_t parameters = 0;  ///< digest of the object's parameters
  std::uint64_t state = 0;       ///< digest of the bytes that follow
};

namespace detail {
/// FNV-1a, 64 bits. It detects damaged bytes, but not forged ones.
inline std::uint64_t digest(std::span<const std::byte> bytes) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
  return hash;
}
template <typename T>
std::uint64_t parameters_of(const T& object) {
  std::vector<std::byte> bytes;
  StateWriter writer(bytes);
  object.describe(writer);
  return digest(bytes);
}
}  // namespace detail

/// The complete state of an object, as bytes.
template <typename T>
std::vector<std::byte> save_state(const T& object) {
  std::vector<std::byte> bytes(sizeof(StateHeader));
  StateWriter writer(bytes);
  T::archive(object, writer);
  const std::span<const std::byte> state = std::span(bytes).subspan(sizeof(StateHeader));
  const StateHeader header{.parameters = detail::parameters_of(object), .state = detail::digest(state)};
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

/// Sets the state of an object from the bytes of save_state(). The object then continues with the same bits.
///
/// Returns false, and does not change the object, if the bytes are damaged, belong to other parameters or have
/// another format version. It does not detect forged bytes: they can contain any finite numbers.
template <typename T>
bool load_state(T& object, std::span<const std::byte> bytes) {
  StateHeader header;
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  const auto state = bytes.subspan(sizeof header);
  if (header.format != StateHeader{}.format || header.state != detail::digest(state) ||
      header.parameters != detail::parameters_of(object))
    return false;
  T loaded = object;
  StateReader reader(state);
  T::archive(loaded, reader);
  if (!reader.good()) return false;
  object = std::move(loaded);
  return true;
}

}  // namespace punctura
