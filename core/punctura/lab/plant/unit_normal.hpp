// A normally distributed number from two uniform ones, with the same bits on every machine. Scalar: a number, or lanes.
#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

#include "punctura/model/lane.hpp"

namespace punctura {

/// x > 0, not denormal, is significand_of(x) * 2^exponent_of(x), with 1 <= significand_of(x) < 2.
inline double exponent_of(double x) noexcept {
  return static_cast<double>(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023);
}
inline double significand_of(double x) noexcept {
  constexpr std::uint64_t digits = 0x000fffffffffffff, one = 0x3ff0000000000000;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & digits) | one);
}

namespace detail {
/// log x for x > 0 that is not denormal, to about 2 units in the last place. The functions of the C library would give
/// other bits on another machine, and have no lanes.
template <typename Scalar>
Scalar portable_log(const Scalar& x) noexcept {
  using namespace lane;
  const Scalar digits = significand_of(x);
  const auto large = digits > std::numbers::sqrt2;
  const Scalar m = select(large, Scalar(digits * 0.5), digits);
  const Scalar exponent = exponent_of(x) + select(large, Scalar(1), Scalar(0));
  // log m = 2 artanh s = 2 (s + s^3 / 3 + s^5 / 5 + ...) with |s| < 0.172. Two sums: the processor adds them together.
  const Scalar s = (m - 1) / (m + 1), z = s * s, w = z * z;
  const Scalar odd = 1. / 3 + w * (1. / 7 + w * (1. / 11 + w * (1. / 15 + w * (1. / 19))));
  const Scalar even = 1. / 5 + w * (1. / 9 + w * (1. / 13 + w * (1. / 17 + w * (1. / 21))));
  return exponent * std::numbers::ln2 + 2 * (s + s * (z * (odd + z * even)));
}

/// sin x for |x| <= pi / 2, to about 1 unit in the last place: its Taylor series.
template <typename Scalar>
Scalar portable_sin(const Scalar& x) noexcept {
  const Scalar y = x * x, w = y * y;
  const Scalar odd =
      -1. / 6 + w * (-1. / 5040 + w * (-1. / 39916800 + w * (-1. / 1307674368000 + w * (-1. / 121645100408832000))));
  const Scalar even =
      1. / 120 +
      w * (1. / 362880 + w * (1. / 6227020800 + w * (1. / 355687428096000 + w * (1. / 51090942171709440000.))));
  return x + x * (y * (odd + y * even));
}
}  // namespace detail

/// A number with mean 0 and variance 1 from u and v, uniform in [0, 1), by the method of Box and Muller:
/// sqrt(-2 log(1 - u)) cos(2 pi v).
template <typename Scalar>
Scalar unit_normal(const Scalar& u, const Scalar& v) noexcept {
  using namespace lane;
  const Scalar radius = sqrt(-2 * detail::portable_log(Scalar(1 - u)));
  const Scalar turn = max(Scalar(v - 0.5), Scalar(0.5 - v)) - 0.25;  // exact; cos(2 pi v) = sin(2 pi turn)
  return radius * detail::portable_sin(Scalar(2 * std::numbers::pi * turn));
}

}  // namespace punctura
