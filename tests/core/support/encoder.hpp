// The encoder of a PHANTOM Omni: its counts and its dither.
#pragma once

#include <cmath>

#include "punctura/lab/plant/noise.hpp"

namespace punctura::test {

inline constexpr double count = 0.055e-3;  ///< m

/// The reported position (m) for a true position x (m). `phase` shifts the grid, in counts.
inline double encoder(double x, double phase = 0) { return (std::floor(x / count + phase + 0.5) - phase) * count; }

enum class Dither {
  toggle,    ///< alternates between n and n+1
  two,       ///< n or n+1 at random
  three,     ///< n-1, n or n+1 at random
  boundary,  ///< a position on the boundary of two counts, with a noise of 1/20 count
};
inline constexpr Dither all_dithers[] = {Dither::toggle, Dither::two, Dither::three, Dither::boundary};

/// The error of the encoder in tick k, m.
inline double dither(Dither kind, int k, Noise& noise) {
  switch (kind) {
    case Dither::toggle: return k % 2 * count;
    case Dither::two: return noise.uniform() < 0.5 ? 0 : count;
    case Dither::three: return (std::floor(3 * noise.uniform()) - 1) * count;
    case Dither::boundary: return encoder((0.5 + noise.normal() / 20) * count);
  }
  return 0;
}

}  // namespace punctura::test
