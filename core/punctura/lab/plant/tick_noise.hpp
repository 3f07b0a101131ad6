// The noise of a tick as a function of a seed and the tick's number: no state, and the same on every machine.
#pragma once

#include <cstdint>

#include "punctura/model/vector3.hpp"

namespace punctura {

/// Number `count` of SplitMix64 (Steele et al. 2014), from 1: it mixes the bits of a counter.
constexpr std::uint64_t split_mix(std::uint64_t key, std::uint64_t count) noexcept {
  std::uint64_t z = key + count * 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

/// Three independent numbers, uniform between -0.5 and 0.5, with 21 bits. The same seed and number give the same ones.
constexpr Vector3d tick_noise(std::uint64_t seed, std::uint64_t number) noexcept {
  const std::uint64_t word = split_mix(split_mix(seed, 1), number + 1);
  const auto of = [](std::uint64_t bits) {
    return (static_cast<double>(static_cast<std::int64_t>(bits & 0x1fffff)) - (0x1p20 - 0.5)) * 0x1p-21;
  };
  return {of(word), of(word >> 21), of(word >> 42)};
}

}  // namespace punctura
