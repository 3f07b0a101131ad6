// Numbers as text and back: to the last bit, whatever the locale says a decimal point is.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#ifndef __cpp_lib_to_chars  // some standard libraries, Apple's among them, have it for integers only
#include <locale.h>
#include <stdlib.h>

#include <array>
#include <cstdio>
#endif

namespace punctura::haply {

/// Whether the first digit that is not 0 stands behind the decimal point, once the exponent has moved that.
inline bool below_one(std::string_view numeral) noexcept {
  const std::size_t e = numeral.find_first_of("eE");
  const std::string_view digits = numeral.substr(0, e);
  const std::size_t first = std::min(digits.find_first_of("123456789"), digits.size());
  const std::size_t point = std::min(digits.find('.'), digits.size());
  // The power of ten of that digit is at least 0 in 12.5, and -1 in 0.5.
  const long long place =
      first < point ? static_cast<long long>(point - first - 1) : -static_cast<long long>(first - point);
  if (e == std::string_view::npos) return place < 0;
  const std::string_view text = numeral.substr(numeral[e + 1] == '+' ? e + 2 : e + 1);
  long long exponent = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec == std::errc::result_out_of_range)
    return text.starts_with('-');
  return exponent < -place;
}

/// A numeral of JSON as the double next to it; nothing where that would be infinite.
inline std::optional<double> decimal(std::string_view text) noexcept {
  double value = 0;
#ifdef __cpp_lib_to_chars
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)  // too large, or so small that 0 is next to it
    return below_one(text) ? std::optional(0.0) : std::nullopt;
  if (error != std::errc() || end != text.data() + text.size()) return {};
#else
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  std::array<char, 400> copy{};
  if (text.size() >= copy.size()) return {};
  text.copy(copy.data(), text.size());
  value = strtod_l(copy.data(), nullptr, plain);
#endif
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// A finite number into `out`, which has 32 bytes or more: the shortest text that gives it back. Its size.
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
