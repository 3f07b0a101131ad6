// The measured work: a stack of membranes and a hand that moves through it and back.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "punctura/scene/scene.hpp"
#include "punctura/signal/low_pass.hpp"

namespace bench {

inline constexpr double rate = 1600, low_pass_hz = 300;  // K06 section 4
inline constexpr std::size_t ticks = 16384;              // 10.24 s of motion

/// `count` membranes of K06 section 4, alternately 1.0 and 0.5 mm thick as in Fig. 12, 3 mm apart or closer to fit
/// into 40 mm.
inline punctura::Scene scene_of(std::size_t count, punctura::Solver solver) {
  punctura::Scene scene{"bench", {1.08e-3, 0.28}, {400, 1}, {}, {rate, 0, solver}, punctura::Direction::stylus};
  const double apart = std::min(3e-3, 40e-3 / static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double thickness = std::min(i % 2 == 0 ? 1.0e-3 : 0.5e-3, apart);
    scene.membranes.push_back(
        {std::to_string(i), {570, 0.41, 0.2, thickness}, {0, -apart * static_cast<double>(i), 0}, {0, -1, 0}});
  }
  return scene;
}

using Point = std::array<double, 3>;

/// Tip and direction of the needle for each tick.
struct Motion {
  std::string name;
  std::vector<Point> measured;  ///< device positions, m
  std::vector<Point> tip;       ///< the positions after the 300 Hz low-pass, the model's input
  std::vector<Point> axis;      ///< of length 1
};

/// Strokes from 2 mm in front of the first surface to 7 mm behind the last, at 20 degrees to the normal, with rests
/// at both ends and a tremor of 8 to 12 Hz and about 0.1 mm. encoder: resolution of the device, m (PHANTOM Omni:
/// 0.055 mm), or 0.
inline Motion strokes(const std::string& name, const punctura::Scene& scene, double encoder) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const double reach = 9e-3 - scene.membranes.back().point[1];
  const double travel = std::max(0.6, reach / 0.03);  // s

  double phase[3][3], hertz[3][3];
  for (auto& axis : phase)
    for (double& p : axis) p = between(0, 2 * std::numbers::pi);
  for (auto& axis : hertz)
    for (double& f : axis) f = between(8, 12);
  const auto tremor = [&](std::size_t axis, double t) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += std::sin(2 * std::numbers::pi * hertz[axis][i] * t + phase[axis][i]);
    return 5e-5 * sum;
  };

  Motion motion{name, {}, {}, {}};
  punctura::LowPass<double> filter[3] = {{low_pass_hz, 1 / rate}, {low_pass_hz, 1 / rate}, {low_pass_hz, 1 / rate}};
  double part_start = 0, part = 0.2, from = 0, to = 0;  // begins with a rest in front
  for (std::size_t k = 0, leg = 0; k < ticks; ++k) {
    const double t = static_cast<double>(k) / rate;
    if (t >= part_start + part) {
      part_start += part;
      ++leg;
      from = to;
      if (leg % 4 == 1) to = reach * between(0.9, 1);
      if (leg % 4 == 3) to = 0;
      part = from == to ? between(0.1, 0.5) : travel * between(0.8, 1.2);
    }
    const double s = (t - part_start) / part;
    const double along = from + (to - from) * s * s * s * (10 - 15 * s + 6 * s * s);  // minimum jerk
    const double lean = 20 * std::numbers::pi / 180 + 0.02 * std::sin(3 * t);
    motion.axis.push_back({std::sin(lean), -std::cos(lean), 0});
    Point p{0.36 * along + tremor(0, t), 2e-3 - along + tremor(1, t), tremor(2, t)};
    if (encoder > 0)
      for (double& x : p) x = encoder * std::round(x / encoder);
    motion.measured.push_back(p);
    motion.tip.push_back({filter[0].step(p[0]), filter[1].step(p[1]), filter[2].step(p[2])});
  }
  return motion;
}

}  // namespace bench
