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

/// Reading k of a healthy device at height y (m).
inline DeviceSample reading(std::uint64_t k, double y) {
  return {k, static_cast<double>(k) / 1600, {0, y, 0}, {0, -1, 0}, 0, true};
}

}  // namespace punctura::test
