#include "punctura/insertion/insertion.hpp"

#include <doctest/doctest.h>

#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
PlacedMembrane at_depth(double depth, double thickness) {
  return {"wall", paper_membrane(thickness), {0, -depth, 0}, {0, -1, 0}};
}
Scene scene(std::vector<PlacedMembrane> membranes) {
  return {"test", paper_needle, {400, 1}, std::move(membranes), {}, Direction::stylus};
}
}  // namespace

TEST_CASE("the force is the sum of the forces of single membranes in scene order, bit for bit") {
  Noise noise(50);
  const auto a = at_depth(0, 1e-3), b = at_depth(3e-3, 0.5e-3), c = at_depth(5e-3, 2e-3);
  for (Solver solver : {Solver::paper, Solver::exact}) {
    auto all = scene({a, b, c});
    all.servo.solver = solver;
    auto together = build_insertion(all);
    std::vector<Insertion> alone;
    for (const auto& membrane : {a, b, c}) {
      auto single = scene({membrane});
      single.servo.solver = solver;
      alone.push_back(build_insertion(single));
    }
    for (double p : random_motion(noise, 5000, 12e-3, 1 / 1600.0)) {
      const Vector3d tip(0.1 * p, -p, 0);
      Vector3d sum = Vector3d::Zero();
      for (auto& insertion : alone) sum += insertion.step(tip, down);
      REQUIRE(together.step(tip, down) == sum);
    }
  }
}

TEST_CASE("the model gets positions from the low-pass") {
  auto filtered = build_insertion(scene({at_depth(0, 1e-3)}));
  LowPass<double, Vector3d> filter(300, 1 / 1600.0);
  for (int k = 0; k < 100; ++k) {
    const Vector3d p(0, 1e-3 - 1e-5 * k, 0);
    filtered.step(p, down);
    CHECK(filtered.tip() == filter.step(p));
  }
}

TEST_CASE("with Direction::motion, b is the direction of the motion and the stylus is ignored") {
  auto from_motion = scene({at_depth(0, 1e-3)});
  from_motion.direction = Direction::motion;
  auto insertion = build_insertion(from_motion);
  CHECK_FALSE(insertion.uses_axis());
  const Vector3d way = Vector3d(1, -2, 0.5).stableNormalized();
  for (int k = 0; k < 1600; ++k) insertion.step(Vector3d(0, 1e-3, 0) + 10e-3 / 1600.0 * k * way, Vector3d(0, 1, 0));
  CHECK(((*insertion.k06())[0].direction() - way).norm() < 1e-9);
  CHECK(insertion.force().norm() > 0.1);
}

TEST_CASE("a motion that grazes the membrane gives no force") {
  auto from_motion = scene({at_depth(0, 1e-3)});
  from_motion.direction = Direction::motion;
  auto insertion = build_insertion(from_motion);
  const Vector3d way = Vector3d(1, -0.15, 0).stableNormalized();  // 81.5 degrees
  for (int k = 0; k < 1600; ++k) {
    insertion.step(Vector3d(0, 1e-4, 0) + 10e-3 / 1600.0 * k * way, down);
    REQUIRE(insertion.force() == Vector3d::Zero());
  }
  CHECK((*insertion.k06())[0].phase() == Phase::barred);
}

TEST_CASE("outside() is true only in front of every membrane") {
  auto insertion = build_insertion(scene({at_depth(0, 1e-3), at_depth(3e-3, 1e-3)}));
  CHECK_FALSE(insertion.outside());
  insertion.step({0, 1e-3, 0}, down);
  CHECK(insertion.outside());
  for (int k = 0; k < 100; ++k) insertion.step({0, 1e-3 - 2e-5 * k, 0}, down);
  CHECK_FALSE(insertion.outside());
}

TEST_CASE("an insertion in float agrees with double") {
  auto d = build_insertion<double>(scene({at_depth(0, 1e-3), at_depth(3e-3, 0.5e-3)}));
  auto f = build_insertion<float>(scene({at_depth(0, 1e-3), at_depth(3e-3, 0.5e-3)}));
  double worst = 0;
  for (int k = 0; k < 3200; ++k) {
    const Vector3d p(0, -3.5e-3 + 4.5e-3 * std::cos(2 * 3.14159265 * k / 1600.0), 0);
    d.step(p, down);
    f.step(p.cast<float>(), down.cast<float>());
    worst = std::max(worst, (d.force() - f.force().cast<double>()).norm());
  }
  MESSAGE("largest difference: " << worst << " N");
  CHECK(worst < 5e-3);
}
