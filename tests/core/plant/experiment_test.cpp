#include "punctura/lab/plant/experiment.hpp"

#include <doctest/doctest.h>

#include "../support/paper_scene.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
const Strokes strokes{{0, 5e-3, 0}, {0, -10e-3, 0}, 2, 1.5, 0.6, 0.05};
}

TEST_CASE("the simulated operator reproduces the pop of K06 Fig. 10 without a fault or a limit") {
  for (Solver solver : {Solver::paper, Solver::exact}) {
    StrokesMotion motion(strokes, 5);
    const auto ticks = static_cast<int>(motion.duration() * 1600);
    Experiment experiment(paper_scene(1e-4, solver), std::move(motion), Vector3d(0, -1, 0), {}, {}, 5);
    double peak = 0, lowest = 0, largest_drop = 0, last = 0;
    for (int k = 0; k < ticks; ++k) {
      const Snapshot& s = experiment.step();
      peak = std::max(peak, s.force[1]);
      lowest = std::min(lowest, s.force[1]);
      if (k > 1600 && s.force[1] > 0.4) largest_drop = std::max(largest_drop, last - s.force[1]);
      last = s.force[1];
    }
    CHECK(peak == doctest::Approx(0.73).epsilon(0.02));
    CHECK(lowest == doctest::Approx(-0.41024).epsilon(0.01));
    CHECK(largest_drop > 0.2);
    CHECK(experiment.servo().fault() == Fault::none);
    CHECK(experiment.servo().snapshot().limits.peak == 0);
    CHECK(experiment.servo().snapshot().limits.continuous == 0);
  }
}

TEST_CASE("the same seed repeats the experiment, bit for bit") {
  const auto run = [](std::uint64_t seed) {
    Experiment experiment(paper_scene(), StrokesMotion(strokes, seed), Vector3d(0, -1, 0), {}, {}, seed);
    double sum = 0;
    for (int k = 0; k < 5000; ++k) sum += experiment.step().force[1] * (k % 7);
    return sum;
  };
  CHECK(run(1) == run(1));
  CHECK(run(1) != run(2));
}

TEST_CASE("a hand that rests in tissue neither creeps nor buzzes") {
  Hand steady;
  steady.tremor_rms = 0;
  Experiment experiment(paper_scene(), RecordedMotion({0, 1, 2}, {{0, 2e-3, 0}, {0, 2e-3, 0}, {0, -4e-3, 0}}),
                        Vector3d(0, -1, 0), {}, steady, 1);
  for (int k = 0; k < 1600 * 4; ++k) experiment.step();
  const Vector3d tip = experiment.tip();
  const auto force = experiment.servo().snapshot().force;
  CHECK(force[1] > 0.1);
  for (int k = 0; k < 1600 * 10; ++k) experiment.step();
  CHECK(experiment.tip() == tip);
  CHECK(experiment.servo().snapshot().force == force);
}

TEST_CASE("a target can be moved while the experiment runs") {
  Experiment experiment(paper_scene(), Target({0, 3e-3, 0}), Vector3d(0, -1, 0));
  for (int k = 0; k < 1600; ++k) experiment.step();
  experiment.motion().move_to({0, -6e-3, 0});
  for (int k = 0; k < 1600; ++k) experiment.step();
  CHECK(experiment.tip().y() < -3e-3);
  CHECK(experiment.servo().snapshot().force[1] > 0.2);
}

TEST_CASE("a steered hand moves with the velocity that was set last, from where it is") {
  Steered hand({0, 3e-3, 0});
  CHECK(hand.at(0.5).position == Vector3d(0, 3e-3, 0));
  hand.steer({0, -2e-3, 0});
  CHECK(hand.at(1.0).position.y() == doctest::Approx(2e-3));
  hand.steer({1e-3, 0, 0});
  const Desired desired = hand.at(3.0);
  CHECK(desired.position.x() == doctest::Approx(2e-3));
  CHECK(desired.position.y() == doctest::Approx(2e-3));
  CHECK(desired.velocity == Vector3d(1e-3, 0, 0));

  const auto made = [] {
    Experiment experiment(paper_scene(), Steered({0, 3e-3, 0}), Vector3d(0, -1, 0), {}, {}, 4);
    experiment.motion().steer({0, -0.01, 0});
    return experiment;
  };
  auto experiment = made(), again = made();
  for (int k = 0; k < 800; ++k) experiment.step();
  REQUIRE(load_state(again, save_state(experiment)));
  for (int k = 0; k < 400; ++k) CHECK(again.step().force == experiment.step().force);
  CHECK(experiment.servo().snapshot().force[1] > 0.1);
}
