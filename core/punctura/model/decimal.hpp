// Numbers from decimal text and back. The locale of the program has no influence.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// LLVM's C++ library, which is also Apple's, does not convert every double with std::from_chars and std::to_chars.
// There the functions of C do it, in the locale "C". A test defines the macro to run them elsewhere.
#if defined(_LIBCPP_VERSION) && !defined(__cpp_lib_to_chars) && !defined(PUNCTURA_C_DECIMALS)
#define PUNCTURA_C_DECIMALS
#endif
#ifdef PUNCTURA_C_DECIMALS
#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

#include <cstdio>
#include <cstdlib>
#endif

namespace punctura {

#ifdef PUNCTURA_C_DECIMALS
/// The locale "C" for this thread, for a while.
class PlainLocale {
 public:
  PlainLocale() noexcept : before_(uselocale(plain())) {}
  ~PlainLocale() { uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  static locale_t plain() noexcept {
    static const locale_t made = newlocale(LC_ALL_MASK, "C", nullptr);
    return made;
  }
  locale_t before_;
};
#endif

inline constexpr std::size_t longest_decimal = 1100;  // characters

/// The double nearest to the number that is the whole text. Nothing if the text is no decimal number or longer than
/// `longest_decimal`, or if the number is outside the range of a double: too large, or not 0 and too small.
inline std::optional<double> read_decimal(std::string_view text) noexcept {
  double value = 0;
  if (text.size() > longest_decimal) return {};
#ifdef PUNCTURA_C_DECIMALS
  // strtod accepts more: space and + in front, hexadecimal numbers.
  if (text.empty() || text.find_first_of(" \t\n\v\f\r+xX") < text.find_first_of("eE")) return {};
  char whole[longest_decimal + 1];
  whole[text.copy(whole, text.size())] = '\0';
  char* end = nullptr;
  const PlainLocale plain;
  value = std::strtod(whole, &end);
  if (end != whole + text.size()) return {};
  const std::string_view digits = text.substr(0, text.find_first_of("eE"));
  if (value == 0 && digits.find_first_of("123456789") != std::string_view::npos) return {};
#else
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
#endif
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Writes a number into `out`, which has 32 bytes or more, and returns the size: a short text that reads as the same
/// number, or, with `digits`, the number rounded to so many digits.
inline std::size_t write_decimal(double value, std::span<char> out, int digits = 0) noexcept {
#ifdef PUNCTURA_C_DECIMALS
  const PlainLocale plain;
  int size = 0;
  for (int n = digits > 0 ? digits : 15; n <= 17; ++n) {
    size = std::snprintf(out.data(), out.size(), "%.*g", n, value);
    if (digits > 0 || !(std::strtod(out.data(), nullptr) != value)) break;
  }
  return static_cast<std::size_t>(size);
#else
  char* const last = out.data() + out.size();
  return static_cast<std::size_t>((digits > 0
                                       ? std::to_chars(out.data(), last, value, std::chars_format::general, digits)
                                       : std::to_chars(out.data(), last, value, std::chars_format::general))
                                      .ptr -
                                  out.data());
#endif
}

/// The same text as a string, for a message.
inline std::string decimal_text(double value, int digits = 0) {
  char text[32];
  return {text, write_decimal(value, text, digits)};
}

/// The double nearest to a decimal number times `factor` times 10^exponent: 1.08 mm is the double 0.00108 m. Infinite
/// or 0 if the product is outside the range of a double.
///
/// A product of doubles would be rounded twice. text: a finite number as TOML and JSON write it. factor: digits.
inline double scaled_decimal(std::string_view text, std::string_view factor, long long exponent) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  std::string digits;
  bool fraction = false;
  for (const char c : text.substr(0, e)) {
    fraction |= c == '.';
    if (c < '0' || c > '9') continue;
    digits += c;
    exponent -= fraction;
  }
  std::vector<int> product(digits.size() + factor.size());  // the last digit first
  for (std::size_t i = 0; i < digits.size(); ++i)
    for (std::size_t k = 0; k < factor.size(); ++k)
      product[i + k] += (digits[digits.size() - 1 - i] - '0') * (factor[factor.size() - 1 - k] - '0');
  std::string number;
  for (std::size_t i = 0, carry = 0; i < product.size(); ++i) {
    carry += static_cast<std::size_t>(product[i]);
    number += static_cast<char>('0' + carry % 10);
    carry /= 10;
  }
  while (!number.empty() && number.back() == '0') number.pop_back();
  std::reverse(number.begin(), number.end());

  long long power = 0;
  std::string_view written = text.substr(std::min(e + 1, text.size()));
  if (written.substr(0, 1) == "+") written.remove_prefix(1);
  if (std::from_chars(written.data(), written.data() + written.size(), power).ec == std::errc::result_out_of_range)
    power = written.front() == '-' ? -1'000'000'000 : 1'000'000'000;
  power += exponent;
  // Of more digits it matters only whether one is not 0: halfway between two doubles there are 768 at most.
  if (constexpr std::size_t most = 800; number.size() > most) {
    power += static_cast<long long>(number.size() - most);
    if (number.find_first_not_of('0', most) != std::string::npos) number[most - 1] = '1';
    number.resize(most);
  }
  const bool too_large = power + static_cast<long long>(number.size()) > 0;
  const double size = number.empty() ? 0
                                     : read_decimal(number + "e" + std::to_string(power))
                                           .value_or(too_large ? std::numeric_limits<double>::infinity() : 0);
  return text.substr(0, 1) == "-" ? -size : size;
}

}  // namespace punctura
