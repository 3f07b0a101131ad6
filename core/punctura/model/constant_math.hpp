// Mathematical functions while a program is compiled: those of the C library are not constexpr in C++20.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>

namespace punctura::detail {

/// The square root, correctly rounded, as a processor gives it. Digit by digit, with 54 bits.
constexpr double constant_sqrt(double x) noexcept {
  if (!(x > 0)) return x == 0 ? x : std::numeric_limits<double>::quiet_NaN();
  if (x > std::numeric_limits<double>::max()) return x;
  int exponent = 0;  // x * 2^exponent is a whole number of 53 or 54 bits, and the exponent is even
  for (; x < 0x1p52; x *= 4) exponent += 2;
  for (; x >= 0x1p54; x /= 4) exponent -= 2;
  const auto whole = static_cast<std::uint64_t>(x);
  std::uint64_t root = 0, rest = 0;
  for (int pair = 53; pair >= 0; --pair) {
    rest = rest << 2 | (pair >= 27 ? whole >> (2 * (pair - 27)) & 3 : 0);
    const std::uint64_t trial = root << 2 | 1;
    root <<= 1;
    if (rest < trial) continue;
    rest -= trial;
    root |= 1;
  }
  auto result = static_cast<double>((root >> 1) + (root & 1)) * 0x1p-26;  // a tie would need a root of 107 bits
  for (; exponent > 0; exponent -= 2) result /= 2;
  for (; exponent < 0; exponent += 2) result *= 2;
  return result;
}

/// sin x and cos x for |x| <= pi / 2, by their power series: to about 2 units in the last place.
struct ConstantCircle {
  double sine = 0, cosine = 0;

  constexpr explicit ConstantCircle(double x) noexcept {
    double terms[28] = {1};
    for (int i = 1; i < 28; ++i) terms[i] = terms[i - 1] * x / i;
    for (int i = 27; i >= 0; --i) (i % 2 ? sine : cosine) += i % 4 < 2 ? terms[i] : -terms[i];  // small ones first
  }
};

}  // namespace punctura::detail
