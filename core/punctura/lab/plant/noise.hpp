// Random numbers that are the same on every machine for the same seed.
#pragma once

#include <cstdint>
#include <random>

#include "punctura/lab/plant/unit_normal.hpp"

namespace punctura {

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

}  // namespace punctura
