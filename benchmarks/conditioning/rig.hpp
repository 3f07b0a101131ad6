// Shared by all measurements of position conditioning: K06's needle and membrane, an encoder, the tested method.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "punctura/scene/build.hpp"

namespace bench {

using punctura::Vector3d;

inline constexpr double T = 1 / 1600.0;    ///< s
inline constexpr double count = 0.055e-3;  ///< m, encoder step of a PHANTOM Omni
inline const Vector3d down{0, -1, 0};      ///< direction of the needle, and the membrane's inward normal
inline constexpr double K = 400, B = 1;    ///< N/m, N s/m: K06 section 4

/// From measured to conditioned position, m.
using Filter = std::function<Vector3d(const Vector3d&)>;

/// A conditioning method. Each run creates a new instance.
struct Method {
  std::string name, note;
  std::function<Filter()> make;
};

/// K06's membrane (section 4) at y = 0 without a filter; the tested method conditions its input.
inline punctura::Insertion bare_model(double thickness, punctura::Solver solver, double stiffness = K) {
  punctura::Scene scene{
      "K06", {1.08e-3, 0.28}, {stiffness, B}, {{"wall", {570, 0.41, 0.2, thickness}, {0, 0, 0}, {0, -1, 0}}}};
  scene.servo.low_pass = 0;
  scene.servo.solver = solver;
  return punctura::build_insertion(scene);
}

/// Encoder reading of x. The grid is shifted by `phase` counts.
inline double encoder(double x, double phase = 0) { return (std::floor(x / count + phase + 0.5) - phase) * count; }

}  // namespace bench
