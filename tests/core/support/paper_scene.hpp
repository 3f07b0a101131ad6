// The scene of K06 section 4 for tests.
#pragma once

#include "punctura/device/sample.hpp"
#include "punctura/scene/scene.hpp"
#include "random_law.hpp"

namespace punctura::test {

/// One membrane with its surface at y = 0. The needle comes from above.
inline Scene paper_scene(double thickness = 1e-3, Solver solver = Solver::exact) {
  Scene scene{"K06", paper_needle,     {400, 1}, {{"wall", paper_membrane(thickness), {0, 0, 0}, {0, -1, 0}}},
              {},    Direction::stylus};
  scene.servo.solver = solver;
  return scene;
}

/// Three walls, 4 mm apart, with at most 1.5 N.
inline Scene three_walls(double force_scale = 1, bool automatic = false) {
  Scene scene = paper_scene();
  scene.membranes.push_back({"second", paper_membrane(0.5e-3), {0, -4e-3, 0}, {0, -1, 0}});
  scene.membranes.push_back({"third", paper_membrane(0.2e-3), {0, -8e-3, 0}, {0, -1, 0}});
  scene.display = {force_scale, automatic};
  return scene;
}

/// Reading k of a healthy device at height y (m).
inline DeviceSample reading(std::uint64_t k, double y) {
  return {k, static_cast<double>(k) / 1600, {0, y, 0}, {0, -1, 0}, 0, true};
}

}  // namespace punctura::test
