// The core in a program without exceptions and run-time type information, as in firmware and web pages.
#include <cmath>
#include <cstdio>

#include "punctura/punctura.hpp"

using namespace punctura;

namespace {

Scene one_wall() {
  Scene scene;
  scene.name = "wall";
  scene.needle = {1.08e-3, 0.28};
  scene.coupling = {400, 1};
  scene.membranes.push_back({"wall", {570, 0.41, 0.2, 1e-3}, {0, 0, 0}, {0, -1, 0}});
  return scene;
}

bool fails(const char* what) {
  std::printf("FAILED: %s\n", what);
  return false;
}

bool a_scene_with_problems_is_not_built() {
  Scene scene = one_wall();
  scene.membranes[0].membrane.friction = -1;
  ForceLimits limits;
  limits.max_force = 0;
  std::vector<Problem> problems;
  if (try_build(scene, problems, {}, limits) || problems.size() != 2) return fails("two problems");
  if (problems[0].path != "membrane[0].friction" || problems[1].path != "limits.max_force") return fails("their paths");
  return !try_build_insertion<float>(scene, problems) || fails("an insertion of a scene with problems");
}

bool the_servo_step_gives_the_force_of_the_proxy() {
  std::vector<Problem> problems;
  Scene scene = one_wall();
  scene.servo.low_pass = 0;
  auto step = try_build(scene, problems);
  if (!step || !problems.empty()) return fails("a sound scene");
  Proxy1d proxy(ThickLaw(scene.needle, scene.membranes[0].membrane), scene.coupling, 1 / scene.servo.rate);
  step->arm();
  double last = 0, expected = 0;
  for (std::uint64_t k = 0; k < 4800; ++k) {
    const double depth = -5e-3 + 5e-3 * static_cast<double>(k) / 1600;
    last = step->step({k, static_cast<double>(k) / 1600, {0, -depth, 0}, {0, -1, 0}, 0, true}).force[1];
    expected = -proxy.step(depth);
  }
  std::printf("force %.6f N\n", last);
  return (std::abs(last - expected) < 1e-12 && last > 0.4) || fails("the force");
}

}  // namespace

int main() { return a_scene_with_problems_is_not_built() && the_servo_step_gives_the_force_of_the_proxy() ? 0 : 1; }
