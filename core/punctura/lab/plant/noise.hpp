// Random numbers that are the same on every machine for the same seed.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "punctura/model/vector3.hpp"

namespace punctura {

namespace detail {
/// log x for x > 0 that is not denormal, to about 2 units in the last place. The functions of the C library would give
/// other bits on another machine.
inline double portable_log(double x) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto digits = std::bit_cast<double>((bits & 0x000fffffffffffff) | 0x3ff0000000000000);
  const bool large = digits > std::numbers::sqrt2;
  const double m = large ? digits * 0.5 : digits;
  const double exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52) - (large ? 1022 : 1023));
  // log m = 2 artanh s = 2 (s + s^3 / 3 + s^5 / 5 + ...) with |s| < 0.172. Two sums: the processor adds them together.
  const double s = (m - 1) / (m + 1), z = s * s, w = z * z;
  const double odd = 1. / 3 + w * (1. / 7 + w * (1. / 11 + w * (1. / 15 + w * (1. / 19))));
  const double even = 1. / 5 + w * (1. / 9 + w * (1. / 13 + w * (1. / 17 + w * (1. / 21))));
  return exponent * std::numbers::ln2 + 2 * (s + s * (z * (odd + z * even)));
}

/// sin x for |x| <= pi / 2, to about 1 unit in the last place: its Taylor series.
inline double portable_sin(double x) noexcept {
  const double y = x * x, w = y * y;
  const double odd =
      -1. / 6 + w * (-1. / 5040 + w * (-1. / 39916800 + w * (-1. / 1307674368000 + w * (-1. / 121645100408832000))));
  const double even =
      1. / 120 +
      w * (1. / 362880 + w * (1. / 6227020800 + w * (1. / 355687428096000 + w * (1. / 51090942171709440000.))));
  return x + x * (y * (odd + y * even));
}
}  // namespace detail

/// A number with mean 0 and variance 1 from u and v, uniform in [0, 1), by the method of Box and Muller:
/// sqrt(-2 log(1 - u)) cos(2 pi v).
inline double unit_normal(double u, double v) noexcept {
  const double radius = std::sqrt(-2 * detail::portable_log(1 - u));
  const double turn = std::max(v - 0.5, 0.5 - v) - 0.25;  // exact; cos(2 pi v) = sin(2 pi turn)
  return radius * detail::portable_sin(2 * std::numbers::pi * turn);
}

/// A random number generator. The C++ standard defines the numbers of std::mt19937_64, but not those of its
/// distributions, and not the bits of std::log and std::cos. Therefore the distributions are implemented here.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) noexcept : engine_(seed) {}

  /// Uniform in [0, 1), with 53 bits.
  double uniform() noexcept { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// Normal with mean 0 and variance 1.
  double normal() noexcept {
    const double u = uniform(), v = uniform();
    return unit_normal(u, v);
  }

 private:
  std::mt19937_64 engine_;
};

inline constexpr std::uint64_t split_mix_step = 0x9e3779b97f4a7c15;

/// Number `count` of SplitMix64 (Steele et al. 2014), from 1: it mixes the bits of a counter.
constexpr std::uint64_t split_mix(std::uint64_t key, std::uint64_t count) noexcept {
  std::uint64_t z = key + count * split_mix_step;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

class TickNoise {
 public:
  constexpr TickNoise(std::uint64_t seed = 0) noexcept : key_(split_mix(seed, 1)) {}

  /// The noise whose number 0 is this number of these.
  constexpr TickNoise from(std::uint64_t number) const noexcept {
    TickNoise later = *this;
    later.key_ += number * split_mix_step;
    return later;
  }

  /// Three independent numbers, uniform between -0.5 and 0.5, with 21 bits. The same number gives the same ones.
  constexpr Vector3d at(std::uint64_t number) const noexcept {
    const std::uint64_t word = split_mix(key_, number + 1);
    const auto of = [](std::uint64_t bits) {  // as the first digits of a number in [1, 2)
      return std::bit_cast<double>((bits & 0xfffff80000000) | 0x3ff0000000000000) - (1.5 - 0x1p-22);
    };
    return {of(word << 31), of(word << 10), of(word >> 11)};
  }

 private:
  std::uint64_t key_;
};

}  // namespace punctura
