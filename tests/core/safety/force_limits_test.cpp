#include "punctura/safety/force_limits.hpp"

#include <doctest/doctest.h>

using namespace punctura;

namespace {
constexpr double T = 1 / 1600.0;
ForceLimiter ramped(const ForceLimits& limits = {}) {
  ForceLimiter limiter(limits, T);
  for (int k = 0; k < 1600; ++k) limiter.step(Vector3d::Zero());
  return limiter;
}
}  // namespace

TEST_CASE("force comes in linearly over half a second") {
  ForceLimiter limiter({}, T);
  for (int k = 1; k <= 800; ++k) CHECK(limiter.step({0, 0.5, 0}).y() == doctest::Approx(0.5 * k / 800.0));
  CHECK(limiter.step({0, 0.5, 0}).y() == 0.5);
  CHECK(limiter.counters().ramp == doctest::Approx(800).epsilon(0.01));
  limiter.reset();
  CHECK(limiter.step({0, 0.5, 0}).y() == doctest::Approx(0.5 / 800));
}

TEST_CASE("a force is clamped by its norm: its direction stays") {
  auto limiter = ramped();
  const Vector3d wanted(3, -4, 12);
  const Vector3d force = limiter.step(wanted);
  CHECK(force.norm() == doctest::Approx(3.3));
  CHECK((force.normalized() - wanted.normalized()).norm() < 1e-15);
  CHECK(limiter.counters().peak == 1);
}

TEST_CASE("a force within the limits passes to the last bit and is not counted") {
  auto limiter = ramped();
  const Vector3d wanted(0.1, 0.7, -0.2);
  for (int k = 0; k < 1000; ++k) REQUIRE(limiter.step(wanted) == wanted);
  CHECK(limiter.counters().peak == 0);
  CHECK(limiter.counters().continuous == 0);
}

TEST_CASE("the pop is not blunted") {
  auto limiter = ramped();
  CHECK(limiter.step({0, 0.73, 0}).y() == 0.73);
  CHECK(limiter.step({0, 0.41, 0}).y() == 0.41);
}

TEST_CASE("the mean force never exceeds the continuous rating, and the ceiling comes down without a step") {
  auto limiter = ramped();
  double mean_square = 0, last = 3.3, largest_step = 0;
  for (int k = 0; k < 1600 * 120; ++k) {
    const double f = limiter.step({0, 3, 0}).norm();
    mean_square += (1 - std::exp(-T / 10)) * (f * f - mean_square);
    largest_step = std::max(largest_step, std::abs(limiter.ceiling() - last));
    last = limiter.ceiling();
  }
  CHECK(std::sqrt(mean_square) <= 0.88 * (1 + 1e-9));
  CHECK(std::sqrt(mean_square) > 0.85);
  CHECK(largest_step < 0.02);
  CHECK(limiter.counters().continuous > 0);
}

TEST_CASE("rest gives the budget back; a reset does not") {
  auto limiter = ramped();
  for (int k = 0; k < 1600 * 60; ++k) limiter.step({0, 3, 0});
  const double spent = limiter.ceiling();
  CHECK(spent < 1.5);
  limiter.reset();
  CHECK(limiter.ceiling() == spent);
  for (int k = 0; k < 1600 * 20; ++k) limiter.rest();
  CHECK(limiter.ceiling() == 3.3);
}
