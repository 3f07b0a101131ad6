// Strong scaling: the same work with more and more threads.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <thread>
#include <vector>

#include "hands.hpp"

namespace punctura::bench_batch {

/// 1, 2, 4 and so on, up to one for each processor; at least 1 and 2.
inline std::vector<std::size_t> thread_counts() {
  const std::size_t most = std::max<std::size_t>(2, std::thread::hardware_concurrency());
  std::vector<std::size_t> counts;
  for (std::size_t n = 1; n < most; n *= 2) counts.push_back(n);
  counts.push_back(most);
  return counts;
}

/// ns of the same work, the fastest round of each.
struct ThreadsNs {
  double wall = 1e300;
  double computed = 1e300;  ///< processor time of all threads
};

/// By number of threads, measured in turn.
inline std::map<std::size_t, ThreadsNs> measure_threads(std::size_t ticks, double seconds,
                                                        const std::function<void(const batch::RunOptions&)>& run) {
  using Clock = std::chrono::steady_clock;
  std::map<std::size_t, ThreadsNs> fastest;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (int round = 0; round < 11 || Clock::now() < end; ++round)
    for (const std::size_t threads : thread_counts()) {
      batch::RunOptions options;
      options.threads = threads;
      options.watch = [](std::size_t, std::size_t) { return true; };  // one thread then starts as two do
      const auto start = Clock::now();
      const std::clock_t computed_start = std::clock();
      run(options);
      const double computed = 1e9 * static_cast<double>(std::clock() - computed_start) / CLOCKS_PER_SEC;
      const double wall = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
      const auto keep = [&](double& least, double ns) { least = std::min(least, ns / static_cast<double>(ticks)); };
      keep(fastest[threads].wall, wall);
      keep(fastest[threads].computed, computed);
    }
  return fastest;
}

inline void print_threads(double seconds) {
  const char* separator = "";
  const auto print = [&](const char* what, const char* solver, const std::map<std::size_t, ThreadsNs>& fastest) {
    std::printf("%s\n    {\"what\": \"%s\", \"solver\": \"%s\", \"counts\": [", separator, what, solver);
    separator = "";
    for (const auto& [threads, ns] : fastest) {
      std::printf("%s{\"threads\": %zu, \"wall_ns\": %.4g, \"computed_ns\": %.4g}", separator, threads, ns.wall,
                  ns.computed);
      separator = ", ";
    }
    std::printf("]}");
    separator = ",";
    std::fprintf(stderr, ".");
  };
  for (const Solver solver : {Solver::paper, Solver::exact}) {
    const char* name = name_of(solver);
    Work work(4096, 800);
    const auto n = static_cast<std::ptrdiff_t>(work.trials);
    batch::LineBatch batch(period, solver);
    for (std::size_t i = 0; i < work.trials; ++i) batch.add(work.laws[i].pieces(), work.couplings[i]);
    print("line", name, measure_threads(work.trials * work.ticks, seconds, [&](const batch::RunOptions& options) {
            batch.reset();
            batch.run(work.ticks, {work.depth.data(), n, 1}, {work.force.data(), n, 1}, options);
          }));
    const batch::SceneBatch all = hands(256, solver, false);
    batch::SceneResults results;
    print("hand", name, measure_threads(all.trials * 1600, seconds, [&](const batch::RunOptions& options) {
            batch::run(all, results, options);
          }));
  }
}

}  // namespace punctura::bench_batch
