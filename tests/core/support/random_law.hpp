// Random admissible needles, membranes and laws, the same on every machine.
#pragma once

#include <cmath>

#include "punctura/lab/plant/noise.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura::test {

inline double between(Noise& noise, double low, double high) { return low + (high - low) * noise.uniform(); }
inline double between_log(Noise& noise, double low, double high) { return low * std::pow(high / low, noise.uniform()); }

inline Vector3d random_direction(Noise& noise) {
  return Vector3d(noise.normal(), noise.normal(), noise.normal()).stableNormalized();
}

struct LawCase {
  Needle needle;
  Membrane membrane;
  double obliquity;
};

/// Tips from 5 to 85 degrees, walls from `thinnest` (m) to 10 mm, mu up to the bound of K06 (7). A_O has both signs.
inline LawCase random_law(Noise& noise, double thinnest = 1e-5) {
  LawCase c{};
  c.needle = {between_log(noise, 0.2e-3, 4e-3), between(noise, 0.09, 1.48)};
  const double largest_friction = std::min(1.5, 0.98 / std::tan(c.needle.tip_angle));
  c.membrane = {between_log(noise, 20, 3000), between(noise, 0, 1.5), between_log(noise, 0.005, largest_friction),
                between_log(noise, thinnest, 1e-2)};
  c.obliquity = between(noise, 0, 1.3);
  return c;
}

/// Needle and membrane of K06 section 4.
inline constexpr Needle paper_needle{1.08e-3, 0.28};
inline constexpr Membrane paper_membrane(double thickness) { return {570, 0.41, 0.2, thickness}; }

}  // namespace punctura::test
