// Numbers to text and back, exact to the last bit, independent of the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#ifndef __cpp_lib_to_chars  // some standard libraries, Apple's among them, convert integers only
#include <locale.h>
#include <stdlib.h>

#include <cerrno>
#include <cstdio>
#endif

namespace punctura::haply {

/// A JSON number as the nearest double. Nothing if it is outside the range of a double: too large, or not 0 and too
/// small.
inline std::optional<double> decimal(std::string_view text) noexcept {
  double value = 0;
#ifdef __cpp_lib_to_chars
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
#else
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  char copy[400] = {};
  if (text.size() >= sizeof copy) return {};
  text.copy(copy, text.size());
  char* end = copy;
  errno = 0;
  value = strtod_l(copy, &end, plain);
  if (errno != 0 || end != copy + text.size()) return {};
#endif
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Writes a finite number into `out`, which has 32 bytes or more, and gives the size: the shortest text that reads as
/// the same number.
inline std::size_t write_decimal(double value, std::span<char> out) noexcept {
#ifdef __cpp_lib_to_chars
  return static_cast<std::size_t>(std::to_chars(out.data(), out.data() + out.size(), value).ptr - out.data());
#else
  const int n = std::snprintf(out.data(), out.size(), "%.17g", value);
  for (char& c : out.first(static_cast<std::size_t>(n)))
    if (c == ',') c = '.';
  return static_cast<std::size_t>(n);
#endif
}

}  // namespace punctura::haply
