#include "punctura/signal/entry_direction.hpp"

#include <doctest/doctest.h>

#include "../support/cases.hpp"
#include "../support/random_law.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
/// The reference: it stores all samples and follows the definition of EntryDirection.
Vector3d oracle(const std::vector<Vector3d>& history, double T) {
  const std::size_t now = history.size() - 1, ticks = static_cast<std::size_t>(std::lround(0.010 / T));
  const std::size_t by_time = now >= ticks ? now - ticks : 0;
  std::size_t by_path = now;
  for (double path = 0; by_path > 0 && path < 2e-4; --by_path) path += (history[by_path] - history[by_path - 1]).norm();
  const Vector3d moved = history[now] - history[std::min(by_time, by_path)];
  return moved.norm() > 0 ? Vector3d(moved.stableNormalized()) : Vector3d::Zero();
}
}  // namespace

TEST_CASE("for a fast tip, the direction is exactly the displacement of the last 10 ms") {
  for (double rate : {500.0, 1000.0, 1600.0, 4000.0}) {
    EntryDirection<double> direction(1 / rate);
    std::vector<Vector3d> history;
    for (int k = 0; k < 2000; ++k) {
      const double t = k / rate;
      history.push_back(0.05 * Vector3d(std::cos(5 * t), std::sin(5 * t), t));
      REQUIRE((direction.step(history.back()) - oracle(history, 1 / rate)).norm() < 1e-12);
    }
  }
}

TEST_CASE("for a slow tip, the direction is that of the last 0.2 mm of path, within one degree" *
          doctest::test_suite("numbers")) {
  Noise noise(40);
  const double T = 1 / 1600.0;
  for (int i = 0; i < at_most(20); ++i) {
    EntryDirection<double> direction(T);
    std::vector<Vector3d> history;
    const double speed = between_log(noise, 1e-4, 1e-2), bend = between(noise, -3, 3);
    Vector3d p = Vector3d::Zero();
    for (int k = 0; k < 3000; ++k) {
      const double turned = bend * k / 3000.0;
      p += speed * T * Vector3d(std::cos(turned), std::sin(turned), 0.3);
      history.push_back(p);
      const Vector3d found = direction.step(p);
      if (k > 0) REQUIRE(found.dot(oracle(history, T)) > std::cos(3.14159 / 180));
    }
  }
}

TEST_CASE("the direction is zero before the tip moves and after a reset") {
  EntryDirection<double> direction(1 / 1600.0);
  for (int k = 0; k < 100; ++k) CHECK(direction.step({1, 2, 3}) == Vector3d::Zero());
  direction.step({1, 2, 3.001});
  CHECK(direction.step({1, 2, 3.001}) == Vector3d(0, 0, 1));
  direction.reset();
  CHECK(direction.step({5, 5, 5}) == Vector3d::Zero());
}

TEST_CASE("a path of many metres does not lose precision in float" * doctest::test_suite("numbers")) {
  EntryDirection<float> direction(1 / 1600.0f);
  for (int k = 0; k < 2000000; ++k) direction.step({0.05f * std::sin(0.01f * static_cast<float>(k % 628)), 0, 0});
  Vector3<float> found;
  for (int k = 0; k < 400; ++k) found = direction.step({0, 1e-6f * static_cast<float>(k), 0});
  CHECK(found.y() > 0.99f);
}
