// The servo step and the simulated device in float.
#include <doctest/doctest.h>

#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

static_assert(std::same_as<decltype(build<float>(Scene{})), ServoStepF>);
static_assert(std::same_as<decltype(build(Scene{})), ServoStep> && std::same_as<ServoStep::Scalar, double>);
static_assert(std::same_as<ServoStepF::Scalar, float> && std::same_as<decltype(ServoStepF::fade_time), const float>);
static_assert(std::same_as<decltype(std::declval<ServoStepF>().insertion().force()), const Vector3<float>&>);
static_assert(std::same_as<decltype(std::declval<ForceLimiterF>().step({}, 0, 0)), Vector3<float>>);
static_assert(std::same_as<decltype(std::declval<PlantF>().measured()), Vector3<float>>);
static_assert(std::same_as<decltype(std::declval<BasicTremor<float>>().step({})), Vector3<float>>);
static_assert(sizeof(InputGateF) < sizeof(InputGate) && sizeof(ForceLimiterF) < sizeof(ForceLimiter));

}  // namespace

TEST_CASE("the servo step in float has the forces of the step in double and no fault") {
  for (Solver solver : {Solver::paper, Solver::exact}) {
    ServoStep in_double = build(paper_scene(1e-3, solver));
    ServoStepF in_float = build<float>(paper_scene(1e-3, solver));
    in_double.arm();
    in_float.arm();
    Noise noise(130);
    double largest = 0, felt = 0;
    std::uint64_t k = 0;
    double y = 3e-3;
    for (double goal : {-8e-3, 3e-3, -6e-3, -5e-3, -9e-3, 3e-3})
      while (y != goal) {
        y += std::clamp(goal - y, -15e-3 * T, 15e-3 * T);
        const DeviceSample sample = reading(k++, y + 1e-6 * noise.normal());
        const Snapshot& a = in_double.step(sample);
        const Snapshot& b = in_float.step(sample);
        REQUIRE(b.fault == Fault::none);
        REQUIRE(b.state == a.state);
        CHECK(b.sample.time == sample.time);
        largest = std::max(largest, std::abs(a.force[1] - b.force[1]));
        felt = std::max(felt, std::abs(a.force[1]));
      }
    CHECK(felt > 0.6);
    CHECK(largest < 2e-3);
    CHECK(largest > 0);  // the results differ, so float was used
  }
}

TEST_CASE("the gate in float finds the same faults as the gate in double, also after a day") {
  const double day = 86400;
  const auto at = [&](std::uint64_t k, double y) {
    DeviceSample sample = reading(k, y);
    sample.time += day;
    return sample;
  };
  InputGateF gate({}, static_cast<float>(T), true);
  for (std::uint64_t k = 0; k < 100; ++k) REQUIRE(gate.step(at(k, 1e-5 * static_cast<double>(k))) == Fault::none);
  InputGateF other = gate;
  CHECK(other.step(at(100, 20e-3)) == Fault::position_jump);
  other = gate;
  CHECK(other.step(at(140, 1e-3)) == Fault::missed_deadline);  // 41 periods: 26 ms
  other = gate;
  CHECK(other.step(at(98, 1e-3)) == Fault::clock);
  DeviceSample sample = at(100, 1e-3);
  sample.position[0] = 1e300;  // infinite in float
  CHECK(gate.step(sample) == Fault::non_finite_input);
}

TEST_CASE("the budget in float keeps the force of each window below the rating") {
  const ForceLimits limits;
  ForceLimiterF limiter(limits, static_cast<float>(T));
  const auto window = static_cast<std::size_t>(limits.continuous_time / T);
  std::vector<double> sums{0};
  Noise noise(131);
  double wanted = 3;
  for (std::size_t k = 0; k < 4 * window; ++k) {
    if (noise.uniform() < 1e-3) wanted = 5 * noise.uniform();
    const float force = limiter.step({0, static_cast<float>(wanted), 0}).norm();
    sums.push_back(sums.back() + force * force * T);
  }
  double most = 0;
  for (std::size_t k = window; k < sums.size(); ++k) most = std::max(most, sums[k] - sums[k - window]);
  const double promised = limits.continuous_force * limits.continuous_force * limits.continuous_time;
  CHECK(most <= promised);
  CHECK(most > 0.5 * promised);
  CHECK(limiter.counters().continuous > 0);
}

TEST_CASE("the simulated device in float moves like the device in double") {
  DeviceDynamics device;
  device.encoder_step = 0;  // a difference of one encoder step would hide other differences
  DeviceDynamicsF device_f;
  device_f.encoder_step = 0;
  Plant plant(device, Hand{}, T, 5);
  PlantF plant_f(device_f, HandF{}, static_cast<float>(T), 5);
  double largest = 0, moved = 0;
  for (int k = 0; k < 3200; ++k) {
    const Desired desired{{0, -5e-3 * std::sin(2e-3 * k), 0}, {0, -10e-3 * 1.6 * std::cos(2e-3 * k), 0}};
    const Vector3d force(0, 0.5 * std::sin(5e-3 * k), 0.1);
    plant.step(force, desired);
    plant_f.step(force.cast<float>(), desired.cast<float>());
    largest = std::max(largest, (plant.tip() - plant_f.tip().cast<double>()).norm());
    moved = std::max(moved, plant.tip().norm());
  }
  CHECK(moved > 3e-3);
  CHECK(largest < 5e-6);
  CHECK(largest > 0);
}
