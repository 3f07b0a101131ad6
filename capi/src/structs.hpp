// Structs that begin with struct_size: a caller may know fewer fields than this library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "punctura.h"

namespace punctura::c {

/// The size of each struct in version 1 of the ABI. A caller's struct is never smaller.
template <typename Struct>
inline constexpr std::size_t first_size = sizeof(Struct);  // add a specialization when a struct grows

template <typename Struct>
bool known_size(const Struct* given) noexcept {
  return given && given->struct_size >= first_size<Struct>;
}

/// Copies the fields that both sides know into the caller's struct.
template <typename Struct>
void give(Struct* to, const Struct& from) noexcept {
  const std::size_t size = to->struct_size;
  std::memcpy(to, &from, std::min(size, sizeof from));
  to->struct_size = size;
}

/// The fields that the caller knows, and the defaults of the others.
template <typename Struct>
Struct taken(const Struct* from, Struct defaults) noexcept {
  std::memcpy(&defaults, from, std::min(from->struct_size, sizeof defaults));
  return defaults;
}

/// For an _init function: fills the caller's struct of `size` bytes with the defaults.
template <typename Struct>
punctura_status init(Struct* given, std::size_t size, const Struct& defaults) noexcept {
  if (!given || size < first_size<Struct>) return PUNCTURA_BAD_ARGUMENT;
  std::memset(given, 0, size);
  std::memcpy(given, &defaults, std::min(size, sizeof defaults));
  given->struct_size = size;
  return PUNCTURA_OK;
}

}  // namespace punctura::c
