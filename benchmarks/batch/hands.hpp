// Trials with a simulated hand: Experiment tick by tick, and each instruction set.
#pragma once

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/batch/scene_batch.hpp"
#include "work.hpp"

namespace punctura::bench_batch {

/// Trials of a second at 1600 Hz with a simulated hand, through a wall of K06 or of measured tissue.
inline batch::SceneBatch hands(std::size_t trials, Solver solver, bool tissue) {
  Scene scene;
  scene.needle = {1.08e-3, 0.28};
  scene.coupling = {400, 1};
  scene.servo.solver = solver;
  scene.membranes.push_back({"wall", {570, 0.41, 0.2, 1e-3}, {0, 0, 0}, {0, -1, 0}});
  if (tissue) {
    auto& wall = scene.membranes[0].tissue;
    wall.profile = {{0, -0.1, 0.05}, {1e-3, -0.3, 0.1}, {2e-3, -0.5, 0.2}, {3e-3, -0.6, 0.25}, {4e-3, -0.4, 0.3}};
    wall.cutting = 0.3;
    wall.set = 0.2;
  }
  const Strokes strokes{{0, 3e-3, 0}, {0, -12e-3, 0}, 1, 0.4, 0.1, 0.1};
  batch::SceneBatch all{.scene = scene, .motion = strokes, .trials = trials, .axis = {0, -1, 0}, .duration = 1};
  batch::Varied friction{"membrane[0].friction", {}};
  for (std::size_t i = 0; i < trials; ++i) {
    friction.values.push_back(0.1 + 0.2 * static_cast<double>(i) / static_cast<double>(trials));
    all.seeds.push_back(i);
  }
  all.varied.push_back(friction);
  return all;
}

/// Only so many trials, once, on all processors: a million, or a few to count instructions.
inline int run_hands(std::size_t trials, Solver solver) {
  const batch::SceneBatch all = hands(trials, solver, false);
  batch::SceneResults results;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t computed = std::clock();
  batch::run(all, results, {});
  std::printf("%zu trials of a second in %.2f s, %.2f s of processor time\n", trials,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
              static_cast<double>(std::clock() - computed) / CLOCKS_PER_SEC);
  return 0;
}

/// Experiment tick by tick without any summary, then batches with theirs. Exits with 3 if the work of a trial differs
/// in one bit.
inline std::vector<Result> measure_hands(std::size_t trials, Solver solver, bool tissue, double seconds) {
  const batch::SceneBatch all = hands(trials, solver, tissue);
  const auto& strokes = std::get<Strokes>(all.motion);
  const std::vector<double>& friction = all.varied[0].values;
  Scene scene = all.scene;
  batch::SceneResults results;
  std::vector<bench::Contestant> contestants{{"core", [&] {
                                                for (std::size_t i = 0; i < trials; ++i) {
                                                  scene.membranes[0].membrane.friction = friction[i];
                                                  Experiment run(scene, StrokesMotion(strokes, i), all.axis, {}, {}, i);
                                                  for (int k = 0; k < 1600; ++k) run.step();
                                                }
                                              }}};
  for (const batch::LineCode* code : batch::line_codes())
    contestants.push_back({code->name, [&, code] {
                             batch::RunOptions options;
                             options.threads = 1;
                             options.code = code;
                             batch::run(all, results, options);
                           }});
  std::vector<double> work;
  for (std::size_t i = 1; i < contestants.size(); ++i) {
    contestants[i].run();
    if (i == 1)
      for (const auto& run : results.runs) work.push_back(run.work);
    for (std::size_t k = 0; k < trials; ++k)
      if (work[k] != results.runs[k].work) {
        std::fprintf(stderr, "%s: the work of a trial differs\n", contestants[i].name.c_str());
        std::exit(3);
      }
  }
  const bench::Times times = bench::time_against_each_other(contestants, trials * 1600, seconds);
  std::vector<Result> found;
  for (std::size_t i = 0; i < contestants.size(); ++i)
    found.push_back({contestants[i].name, times.spreads[i], bench::ratio(times.rounds[0], times.rounds[i])});
  return found;
}

}  // namespace punctura::bench_batch
