// 200 random scenes and motions with the same bits on every machine. They use only + - * /, sqrt and safe tangents.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "punctura/lab/plant/noise.hpp"
#include "punctura/scene/scene.hpp"

namespace punctura::test {

inline constexpr std::size_t golden_count = 200;
inline constexpr std::size_t golden_ticks = 1000;

/// Tip angles, rad, with safe tangents: each is within 0.05 units in the last place of a double and of a float.
/// Therefore every C library rounds it to the same number.
inline constexpr std::array golden_angles = {0.2979525, 0.3709212, 0.3742132, 0.4893193, 0.5003197, 0.5670633,
                                             0.5909259, 0.6773731, 0.705416,  0.8561216, 0.9474528, 0.9595543,
                                             1.1373115, 1.2361852, 1.2818929, 1.2987622};

struct GoldenCase {
  Scene scene;
  std::vector<Vector3d> positions;  ///< of the tip, m, one per tick
  Vector3d axis;                    ///< of the needle
};

/// Scene k: 1 to 4 walls across y. One wall in ten has thickness 0. The needle moves in strokes, up to 40 degrees
/// from the normal.
inline GoldenCase golden_case(std::size_t k) {
  Noise noise(1000 + k);
  const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(); };
  const auto one_in = [&](int n) { return noise.uniform() * n < 1; };

  GoldenCase c;
  c.scene.needle = {between(0.3e-3, 2e-3), golden_angles[k % golden_angles.size()]};
  c.scene.coupling = {between(100, 2000), one_in(10) ? 0 : between(0.05, 5)};
  c.scene.direction = one_in(5) ? Direction::motion : Direction::stylus;
  c.scene.servo.rate = one_in(3) ? 1000 : 1600;
  c.scene.servo.low_pass = 0;  // its gain needs exp(), which differs between C libraries
  double depth = 0;
  const std::size_t walls = 1 + static_cast<std::size_t>(between(0, 4));
  for (std::size_t i = 0; i < walls; ++i) {
    const double tangent_bound = 4;  // the largest tangent of the angles above: mu tan(theta) < 1, K06 (7)
    const Membrane wall{between(50, 2000), between(0, 1), between(0.01, 0.9 / tangent_bound),
                        one_in(10) ? 0 : between(0.02e-3, 4e-3)};
    c.scene.membranes.push_back({"wall", wall, {0, -depth, 0}, {0, -1, between(-0.2, 0.2)}});
    depth += between(0.5e-3, 8e-3);
  }

  const Vector3d axis{between(-0.6, 0.6), -1, between(-0.6, 0.6)};  // braces fix the order of the calls
  c.axis = axis / std::sqrt(axis.dot(axis));
  const double reach = depth + 10e-3, period = 1 / c.scene.servo.rate;
  double along = -2e-3;  // distance from the surface along the axis, m
  Vector3d sideways = Vector3d::Zero();
  while (c.positions.size() < golden_ticks) {
    const double goal = between(-3e-3, reach), speed = between(0.005, 0.3), kind = noise.uniform();
    const auto ticks = static_cast<std::size_t>(between(10, 120));
    for (std::size_t i = 0; i < ticks && c.positions.size() < golden_ticks; ++i) {
      if (kind < 0.7) along += std::clamp(goal - along, -speed * period, speed * period);
      if (kind > 0.6) sideways += Vector3d{between(-1e-5, 1e-5), between(-1e-5, 1e-5), between(-1e-5, 1e-5)};
      c.positions.push_back(c.axis * along + sideways);
    }
    if (kind > 0.95) along = goal;  // a jump
  }
  return c;
}

}  // namespace punctura::test
