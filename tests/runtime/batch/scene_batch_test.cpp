// Runs of a scene in lanes: each trial has the bits of the same trial computed alone.
#include "punctura_runtime/batch/scene_batch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>

#include "core/support/cases.hpp"
#include "core/support/paper_scene.hpp"
#include "punctura_runtime/batch/run_line.hpp"

using namespace punctura;

namespace {

struct SceneBatchResults {
  batch::SceneResults numbers;
  std::vector<double> force;
  std::size_t in_lanes() const {
    return static_cast<std::size_t>(
        std::count_if(numbers.runs.begin(), numbers.runs.end(), [](const auto& run) { return run.in_lanes; }));
  }
};

constexpr std::size_t scene_batch_ticks = 480;

/// Two walls that the needle meets at two angles; hands, devices, filters and rates that differ.
batch::SceneBatch scene_batch(Solver solver, std::size_t trials) {
  Scene scene = test::paper_scene(1e-3, solver);
  scene.membranes.push_back({"second", test::paper_membrane(0.3e-3), {0, -3e-3, 0}, {0.1, -1, 0.2}});
  batch::SceneBatch all{.scene = scene,
                        .motion = Strokes{{0, 2e-3, 0}, {1e-3, -8e-3, 0}, 1, 0.1, 0.02, 0.2},
                        .trials = trials,
                        .axis = {0.05, -1, 0}};
  Noise noise(3);
  // 0 in one of `every` trials.
  const auto vary = [&](const char* path, double low, double high, std::size_t every = 0) {
    batch::Varied one{path, {}};
    for (std::size_t i = 0; i < trials; ++i) {
      const double x = low + (high - low) * noise.uniform();
      one.values.push_back(every > 0 && i % every == 1 ? 0 : x);
    }
    all.varied.push_back(one);
  };
  vary("membrane[0].friction", 0.05, 0.4);
  vary("membrane[0].thickness", 1e-5, 2e-3, 5);
  vary("coupling.stiffness", 200, 600);
  vary("servo.low_pass", 100, 500, 4);
  vary("servo.rate", 1500, 1700);
  vary("hand.stiffness", 300, 900);
  vary("hand.tremor_rms", 1e-5, 1e-4, 6);
  vary("plant.encoder_step", 1e-5, 1e-4, 3);
  vary("strokes.duration", 0.08, 0.15);
  for (std::size_t i = 0; i < trials; ++i) all.seeds.push_back(100 + i);
  return all;
}

/// Walls that are cut and keep a hole, of every kind of grip, and of K06; the needle enters twice.
batch::SceneBatch tissue_batch(Solver solver, double relaxing, std::size_t trials) {
  batch::SceneBatch all = scene_batch(solver, trials);
  std::erase_if(all.varied, [](const auto& one) { return one.path == "servo.rate" || one.path == "strokes.duration"; });
  all.motion = Strokes{{0, 2e-3, 0}, {1e-3, -9e-3, 0}, 2, 0.065, 0.005, 0.05};
  all.duration = scene_batch_ticks / all.scene.servo.rate;
  all.scene.servo.sub_steps = relaxing > 0 ? 2 : 1;
  if (relaxing > 0) all.scene.relaxation = {{relaxing, 0.05}, {0.5 * relaxing, 0.4}};
  auto& membranes = all.scene.membranes;
  membranes[0].tissue.grip = GripShape::exponential;
  membranes[1].tissue.grip = GripShape::table;
  membranes[1].tissue.grip_table = {{0, 0.3}, {4e-4, 0.5}, {8e-4, 0.55}};
  PlacedMembrane third = membranes[0];
  third.name = "third";
  third.point = {0, -5e-3, 0};
  third.tissue = {};
  third.tissue.profile = {{0, -0.1, 0.05}, {1e-3, -0.6, 0.2}, {2e-3, -0.4, 0.3}, {2e-3, -0.3, 0.3}};
  third.tissue.tip_length = 1e-3;
  third.membrane.thickness = 5e-3;  // the needle comes back before its whole tip has passed this wall
  membranes.push_back(third);
  Noise noise(5);
  const auto vary = [&](const char* path, double high, std::size_t every) {  // 0 in one of `every` trials
    batch::Varied one{path, {}};
    for (std::size_t i = 0; i < trials; ++i) one.values.push_back(i % every == 1 ? 0 : high * noise.uniform());
    all.varied.push_back(one);
  };
  vary("membrane[0].growth", 400, 3);
  vary("membrane[0].cutting", 0.8, 4);
  vary("membrane[0].set", 0.6, 5);
  vary("membrane[1].tail_length", 3e-3, 3);
  vary("membrane[1].tail_floor", 1, 4);
  vary("membrane[1].thickness", 1e-3, 7);
  vary("membrane[2].cutting", 0.5, 2);
  vary("membrane[2].set", 0.7, 3);
  if (relaxing > 0) vary("coupling.relaxation[0].stiffness", relaxing, trials + 1);
  return all;
}

SceneBatchResults run_all(const batch::SceneBatch& all, const batch::RunOptions& options, bool keep = false) {
  SceneBatchResults results;
  results.force.resize(keep ? 3 * all.trials * scene_batch_ticks : 0);
  if (keep) results.numbers.force = results.force.data();
  CHECK_FALSE(batch::check(all, options));
  CHECK(batch::run(all, results.numbers, options));
  return results;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// The number of trials that differ in one bit.
std::size_t differ(const SceneBatchResults& a, const SceneBatchResults& b) {
  using R = batch::RunNumbers;
  using M = batch::MembraneNumbers;
  std::size_t found = 0;
  for (std::size_t i = 0; i < a.numbers.runs.size(); ++i) {
    const auto &x = a.numbers.runs[i], &y = b.numbers.runs[i];
    bool equal = x.fault == y.fault;
    for (const auto member : {&R::peak, &R::felt_peak, &R::depth, &R::work, &R::dwell, &R::limited})
      equal = equal && same(x.*member, y.*member);
    const std::size_t m = a.numbers.membranes.size() / a.numbers.runs.size();
    for (std::size_t j = i * m; j < (i + 1) * m; ++j) {
      const auto &u = a.numbers.membranes[j], &v = b.numbers.membranes[j];
      equal = equal && u.pops == v.pops;
      for (const auto member : {&M::first_pop, &M::drop, &M::overshoot}) equal = equal && same(u.*member, v.*member);
    }
    found += !equal;
  }
  return found;
}

batch::RunOptions options_of(const char* code, std::size_t threads = 1, std::size_t block = 256) {
  batch::RunOptions options;
  options.code = batch::line_code(code);
  options.threads = threads;
  options.block = block;
  return options;
}

}  // namespace

TEST_CASE("trials with a hand have the bits of trials alone with each instruction set, block and number of threads") {
  const auto trials = static_cast<std::size_t>(test::at_most(45));
  for (const Solver solver : {Solver::paper, Solver::exact}) {
    const batch::SceneBatch all = scene_batch(solver, trials);
    const SceneBatchResults alone = run_all(all, options_of("portable", 2));
    CHECK(alone.in_lanes() == 0);
    std::size_t pops = 0;
    for (const auto& membrane : alone.numbers.membranes) pops += membrane.pops;
    CHECK(pops > trials);
    for (const batch::LineCode* code : batch::line_codes()) {
      CAPTURE(code->name);
      for (const auto& [threads, block] : {std::pair<std::size_t, std::size_t>{1, 4096}, {2, 1}, {7, 9}}) {
        const SceneBatchResults together = run_all(all, options_of(code->name, threads, block));
        CHECK(together.in_lanes() == (code->scene_exact ? trials : 0));
        CHECK(differ(alone, together) == 0);
      }
    }
  }
}

TEST_CASE("trials through measured tissue have the bits of trials alone with each instruction set" *
          doctest::test_suite("numbers")) {
  const auto trials = static_cast<std::size_t>(test::at_most(41));
  for (const Solver solver : {Solver::paper, Solver::exact})
    for (const double relaxing : {0.0, 300.0}) {
      const batch::SceneBatch all = tissue_batch(solver, relaxing, trials);
      const SceneBatchResults alone = run_all(all, options_of("portable", 2), true);
      CHECK(alone.in_lanes() == 0);
      CHECK(std::ranges::count(alone.numbers.membranes, 2u, &batch::MembraneNumbers::pops) >
            static_cast<int>(trials / 4));  // a hole entered again
      for (const batch::LineCode* code : batch::line_codes()) {
        CAPTURE(code->name);
        for (const auto& [threads, block] : {std::pair<std::size_t, std::size_t>{1, 4096}, {2, 9}}) {
          const SceneBatchResults together = run_all(all, options_of(code->name, threads, block), true);
          // The coupling of trial 1 has a branch less than the others, so it runs alone.
          CHECK(together.in_lanes() == (!code->scene_exact ? 0 : relaxing > 0 ? trials - 1 : trials));
          CHECK(differ(alone, together) == 0);
          CHECK(std::equal(alone.force.begin(), alone.force.end(), together.force.begin(), same));
        }
      }
    }
}

TEST_CASE("trials in lanes with a line fit and the direction of the motion have the bits of trials alone") {
  batch::SceneBatch all = scene_batch(Solver::exact, 21);
  all.scene.servo.conditioning = Conditioning::line_fit;
  all.scene.direction = Direction::motion;
  all.varied.push_back({"servo.encoder_step", std::vector<double>(21, 4e-5)});
  all.varied.back().values[3] = 0;
  const auto alone = run_all(all, options_of("portable"));
  for (const batch::LineCode* code : batch::line_codes()) {
    const auto together = run_all(all, options_of(code->name));
    CHECK(together.in_lanes() == (code->scene_exact ? 21 : 0));
    CHECK(differ(alone, together) == 0);
  }
}

TEST_CASE("trials in lanes give the model's force of each tick") {
  batch::SceneBatch all = scene_batch(Solver::exact, 9);
  all.duration = 0.3;
  std::erase_if(all.varied, [](const batch::Varied& one) { return one.path == "servo.rate"; });
  const auto alone = run_all(all, options_of("portable"), true), together = run_all(all, options_of(""), true);
  CHECK(std::equal(alone.force.begin(), alone.force.end(), together.force.begin(), same));
  CHECK(differ(alone, together) == 0);
}

TEST_CASE("a trial that lanes cannot compute runs alone, beside lanes") {
  batch::SceneBatch all = scene_batch(Solver::exact, 12);
  all.varied.push_back({"servo.sub_steps", std::vector<double>(12, 1)});
  all.varied.back().values[5] = 2;
  for (batch::Varied& one : all.varied) {  // a hand that throws the device
    if (one.path == "hand.stiffness") one.values[7] = 1e6;
    if (one.path == "strokes.duration") one.values[7] = 1e-3;
  }
  const auto alone = run_all(all, options_of("portable")), together = run_all(all, options_of(""));
  CHECK(alone.numbers.runs[7].fault == Fault::position_jump);
  CHECK(differ(alone, together) == 0);
  if (batch::line_codes().front()->scene_exact) {
    CHECK(together.in_lanes() == 10);
    CHECK_FALSE(together.numbers.runs[5].in_lanes);
    CHECK_FALSE(together.numbers.runs[7].in_lanes);
  }
}

TEST_CASE("trials in lanes along a recorded motion, and none at all") {
  batch::SceneBatch all = scene_batch(Solver::exact, 9);
  std::erase_if(all.varied, [](const batch::Varied& one) { return one.path == "strokes.duration"; });
  std::vector<double> time;
  std::vector<Vector3d> position;
  for (std::size_t k = 0; k < 30; ++k) {
    time.push_back(5 + 0.01 * static_cast<double>(k));
    position.push_back({0, 2e-3 - 1e-3 * static_cast<double>(std::min<std::size_t>(k, 10)), 0});
  }
  all.motion = RecordedMotion(time, position);
  CHECK(differ(run_all(all, options_of("portable")), run_all(all, options_of(""))) == 0);
  all.duration = 0;
  CHECK(differ(run_all(all, options_of("portable")), run_all(all, options_of(""))) == 0);
}

TEST_CASE("trials in lanes along positions, with a needle that turns") {
  batch::SceneBatch all = scene_batch(Solver::exact, 9);
  std::erase_if(all.varied, [](const batch::Varied& one) { return !one.path.starts_with("membrane"); });
  std::vector<double> position, axis;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t k = 0; k < scene_batch_ticks; ++k) {
      const double u = static_cast<double>(k) / scene_batch_ticks, depth = 10e-3 + 1e-4 * static_cast<double>(i);
      position.insert(position.end(), {1e-3 * u, 1e-3 - 4 * depth * u * (1 - u), 5e-4 * std::sin(20 * u)});
      if (i == 0) axis.insert(axis.end(), {0.3 * u, -1, 0});
    }
  const auto stride = static_cast<std::ptrdiff_t>(3 * scene_batch_ticks);
  for (const std::ptrdiff_t by_trial : {stride, std::ptrdiff_t{0}}) {
    all.motion = batch::Positions{position.data(), by_trial, axis.data(), 3, scene_batch_ticks};
    const auto alone = run_all(all, options_of("portable"), true), together = run_all(all, options_of(""), true);
    CHECK(alone.numbers.membranes[1].pops > 0);
    CHECK(differ(alone, together) == 0);
    CHECK(std::equal(alone.force.begin(), alone.force.end(), together.force.begin(), same));
    CHECK(together.in_lanes() == (batch::line_codes().front()->scene_exact ? 9 : 0));
  }
}
