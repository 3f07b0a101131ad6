// How the time grows: with the trials, with the ticks of a run, and with the membranes.
#pragma once

#include "hands.hpp"
#include "work.hpp"

namespace punctura::bench_batch {

/// The fastest of several rounds, ns for each of `count`.
inline double fastest_ns(std::size_t count, const std::function<void()>& run) {
  run();
  double fastest = 1e300;
  for (int i = 0; i < 9; ++i) {
    const double start = bench::computed_ns();
    run();
    bench::keep_memory();
    fastest = std::min(fastest, bench::computed_ns() - start);
  }
  return fastest / static_cast<double>(count);
}

/// ns per trial and tick of the paper's solver with the fastest instruction set.
inline double line_ns(std::size_t trials, std::size_t ticks) {
  Work work(trials, ticks);
  const auto n = static_cast<std::ptrdiff_t>(trials);
  batch::LineBatch batch(period, Solver::paper);
  for (std::size_t i = 0; i < trials; ++i) batch.add(work.laws[i].pieces(), work.couplings[i]);
  batch::RunOptions options;
  options.threads = 1;
  return fastest_ns(trials * ticks, [&] {
    batch.reset();
    batch.run(ticks, {work.depth.data(), n, 1}, {work.force.data(), n, 1}, options);
  });
}

/// ns per trial and tick of a simulated hand, with so many membranes 2 mm apart.
inline double hands_ns(std::size_t membranes) {
  batch::SceneBatch all = hands(64, Solver::exact, false);
  for (std::size_t i = 1; i < membranes; ++i) {
    auto next = all.scene.membranes[0];
    next.name += std::to_string(i);
    next.point[1] = -2e-3 * static_cast<double>(i);
    all.scene.membranes.push_back(next);
  }
  batch::SceneResults results;
  batch::RunOptions options;
  options.threads = 1;
  return fastest_ns(all.trials * 1600, [&] { batch::run(all, results, options); });
}

/// As JSON: lists of [trials, ticks, ns] and of [membranes, ns].
inline void print_growth() {
  std::printf("\n  \"growth\": {\"line\": [");
  const char* separator = "";
  for (const auto& [trials, ticks] : {std::pair<std::size_t, std::size_t>{8, 4000},
                                      {32, 4000},
                                      {128, 4000},
                                      {1024, 4000},
                                      {8192, 400},
                                      {65536, 64},
                                      {32, 100},
                                      {32, 1000},
                                      {32, 100'000}}) {
    std::printf("%s[%zu, %zu, %.4g]", separator, trials, ticks, line_ns(trials, ticks));
    separator = ", ";
  }
  std::printf("], \"membranes\": [");
  separator = "";
  for (const std::size_t membranes : {1u, 2u, 4u, 8u}) {
    std::printf("%s[%zu, %.4g]", separator, membranes, hands_ns(membranes));
    separator = ", ";
  }
  std::printf("]}");
}

}  // namespace punctura::bench_batch
