// The noise of a tick as a function of a seed and the tick's number: no state, and the same on every machine.
#pragma once

#include <bit>
#include <cstdint>

#include "punctura/model/vector3.hpp"

namespace punctura {

inline constexpr std::uint64_t split_mix_step = 0x9e3779b97f4a7c15;

/// Number `count` of SplitMix64 (Steele et al. 2014), from 1: it mixes the bits of a counter.
constexpr std::uint64_t split_mix(std::uint64_t key, std::uint64_t count) noexcept {
  std::uint64_t z = key + count * split_mix_step;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

/// The noise of a seed.
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
