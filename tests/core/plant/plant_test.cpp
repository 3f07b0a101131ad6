#include "punctura/lab/plant/plant.hpp"

#include <doctest/doctest.h>

#include "../support/tick.hpp"
#include "punctura/lab/plant/motion.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
const Desired origin{Vector3d::Zero(), Vector3d::Zero()};
const DeviceDynamics frictionless{0.045, 0, 0, 3.3};
const Hand steady{0.05, 4, 500, 0, 9};
}  // namespace

TEST_CASE("without friction the tip settles at the balance of spring and force") {
  Plant plant(frictionless, steady, T);
  for (int k = 0; k < 3200; ++k) plant.step({0, 0.5, 0}, origin);
  CHECK(plant.tip().y() == doctest::Approx(0.5 / 500).epsilon(1e-9));
}

TEST_CASE("the free response is that of a mass, a damper and a spring") {
  Plant plant(frictionless, steady, T);
  plant.place({1e-2, 0, 0});
  const double m = 0.095, omega = std::sqrt(500 / m - 4 * 4 / (4 * m * m)), decay = 4 / (2 * m);
  double worst = 0;
  for (int k = 1; k < 800; ++k) {
    plant.step(Vector3d::Zero(), origin);
    const double t = k * T;
    const double exact = 1e-2 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    worst = std::max(worst, std::abs(plant.tip().x() - exact));
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("dry friction holds the tip below the friction force and subtracts that force above") {
  Plant plant(DeviceDynamics{}, steady, T);
  for (int k = 0; k < 1600; ++k) plant.step({0.2, 0, 0}, origin);
  CHECK(plant.tip() == Vector3d::Zero());
  for (int k = 0; k < 4800; ++k) plant.step({0.6, 0, 0}, origin);
  CHECK(plant.velocity() == Vector3d::Zero());  // it rests and does not creep
  CHECK(plant.tip().x() > (0.6 - 0.26) / 500 - 1e-6);
  CHECK(plant.tip().x() < (0.6 + 0.26) / 500);
}

TEST_CASE("saturate() limits the norm of the force and keeps its direction") {
  const DeviceDynamics device;
  CHECK(device.saturate({3, 4, 0}).norm() == doctest::Approx(3.3));
  CHECK(device.saturate({3, 4, 0}).x() == doctest::Approx(3.3 * 0.6));
  CHECK(device.saturate({1, 2, 0}) == Vector3d(1, 2, 0));
}

TEST_CASE("the encoders report steps within half a step of the true position") {
  DeviceDynamics device;
  device.friction = 0;
  Plant plant(device, steady, T, 7);
  Vector3d last = Vector3d::Constant(1e9);
  for (int k = 0; k < 1600; ++k) {
    plant.step(Vector3d::Zero(), {Vector3d(1e-2, -2e-3, 3e-3), Vector3d::Zero()});
    const Vector3d measured = plant.measured();
    REQUIRE((measured - plant.tip()).maxAbs() <= 0.5001 * device.encoder_step);
    if (k > 0) {
      const Vector3d counts = (measured - last) / device.encoder_step;
      for (double count : counts) REQUIRE(std::abs(count - std::round(count)) < 1e-9);
    }
    last = measured;
  }
}

TEST_CASE("the same seed gives the same run, bit for bit, and another seed a different run") {
  const auto run = [](std::uint64_t seed) {
    Plant plant(DeviceDynamics{}, Hand{}, T, seed);
    for (int k = 0; k < 2000; ++k)
      plant.step({0, 0.01 * (k % 50), 0}, {Vector3d(1e-6 * k, 0, 0), Vector3d(1e-6 / T, 0, 0)});
    return Vector3d(plant.measured() + 1e-3 * plant.tip());
  };
  CHECK(run(3) == run(3));
  CHECK(run(3) != run(4));
}

TEST_CASE("tremor has the given rms and frequency") {
  Hand hand;
  hand.tremor_rms = 5e-5;
  Tremor tremor(hand, T);
  double sum = 0;
  int crossings = 0;
  double last = 0;
  constexpr int n = 1600 * 400;
  for (int k = 0; k < n; ++k) {
    const double y = tremor.step(tremor_noise(1, static_cast<std::uint64_t>(k))).x();
    sum += y * y;
    crossings += (y > 0) != (last > 0);
    last = y;
  }
  CHECK(std::sqrt(sum / n) == doctest::Approx(5e-5).epsilon(0.05));
  CHECK(crossings / 2.0 / 400 == doctest::Approx(9).epsilon(0.15));
  hand.tremor_rms = 0;
  Tremor none(hand, T);
  CHECK(none.is_off());
}

TEST_CASE("strokes go from start to end and back, rest at both ends and vary with the seed") {
  const Strokes strokes{{0, 5e-3, 0}, {0, -8e-3, 0}, 3, 1.0, 0.5, 0.1};
  StrokesMotion motion(strokes, 1), other(strokes, 2);
  CHECK(motion.duration() != other.duration());
  CHECK(motion.at(0).position == strokes.start);
  double deepest = 1;
  Vector3d last = strokes.start;
  for (double t = 0; t < motion.duration(); t += 1e-3) {
    const Desired d = motion.at(t);
    deepest = std::min(deepest, d.position.y());
    CHECK((d.position - last).norm() < 40e-3 * 1e-3);
    last = d.position;
  }
  CHECK(deepest < -5e-3);
  CHECK(deepest > -13e-3);
  CHECK(motion.at(motion.duration()).position == strokes.start);
  CHECK(motion.at(motion.duration()).velocity == Vector3d::Zero());
}

TEST_CASE("the velocity of strokes is the derivative of their position") {
  StrokesMotion motion({{0, 0, 0}, {1e-2, 0, 0}, 1, 1.0, 0.1, 0}, 0);
  Desired before = motion.at(0);
  for (double t = 1e-4; t < motion.duration(); t += 1e-4) {
    const Desired now = motion.at(t);
    CHECK(now.velocity.x() ==
          doctest::Approx((now.position.x() - before.position.x()) / 1e-4).epsilon(0.02).scale(1e-3));
    before = now;
  }
}

TEST_CASE("a recorded motion is linear between samples and rests before and after them") {
  RecordedMotion motion({1, 2, 4}, {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}});
  CHECK(motion.duration() == 3);
  CHECK(motion.at(0).position == Vector3d::Zero());
  CHECK(motion.at(0.5).position == Vector3d(0.5, 0, 0));
  CHECK(motion.at(0.5).velocity == Vector3d(1, 0, 0));
  CHECK(motion.at(2).position == Vector3d(1, 1, 0));
  CHECK(motion.at(9).position == Vector3d(1, 2, 0));
  CHECK(motion.at(9).velocity == Vector3d::Zero());
}

TEST_CASE("strokes and recorded motions can begin again, at any time") {
  StrokesMotion strokes({{0, 0, 0}, {1e-2, 0, 0}, 2, 1.0, 0.1, 0.1}, 0);
  RecordedMotion recorded({1, 2, 4}, {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}});
  const auto at = [](auto motion, double time) { return motion.at(time).position; };  // of a copy, from its beginning
  const StrokesMotion new_strokes = strokes;
  const RecordedMotion new_recorded = recorded;
  for (const double time : {0.7, 9.0, 0.0, 2.4, 2.3, 0.05, 1.0}) {
    CHECK(strokes.at(time).position == at(new_strokes, time));
    CHECK(recorded.at(time).position == at(new_recorded, time));
  }
}

TEST_CASE("the hand follows a target that jumps smoothly and reaches it") {
  Target target(Vector3d::Zero());
  target.at(0);
  target.move_to({1e-2, 0, 0});
  Vector3d last = Vector3d::Zero();
  for (int k = 1; k < 1600; ++k) {
    const Desired d = target.at(k * T);
    CHECK((d.position - last).norm() < 2e-4);
    last = d.position;
  }
  CHECK(last.x() == doctest::Approx(1e-2));
}
