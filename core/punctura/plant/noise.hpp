// Random numbers that are the same on every machine for the same seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace punctura {

/// The standard fixes the engine's numbers but not its distributions, so those stand here.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) noexcept : engine_(seed) {}

  /// In [0, 1), 53 bits.
  double uniform() noexcept { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// Mean 0, variance 1, by Box and Muller.
  double normal() noexcept {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace punctura
