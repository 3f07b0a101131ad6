// Two threads against one.
#pragma once

#include <chrono>
#include <functional>

#include "hands.hpp"

namespace punctura::bench_batch {

/// ns of the same work with 1 and with 2 threads, in turn: the fastest round of each.
struct Threads {
  double wall[2] = {1e300, 1e300};
  double computed[2] = {1e300, 1e300};  ///< processor time of all threads
};
inline Threads measure_threads(std::size_t ticks, double seconds,
                               const std::function<void(const batch::RunOptions&)>& run) {
  using Clock = std::chrono::steady_clock;
  Threads fastest;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (int round = 0; round < 11 || Clock::now() < end; ++round)
    for (const std::size_t threads : {1u, 2u}) {
      batch::RunOptions options;
      options.threads = threads;
      options.watch = [](std::size_t, std::size_t) { return true; };  // one thread then starts as two do
      const auto start = Clock::now();
      const std::clock_t computed_start = std::clock();
      run(options);
      const double computed = 1e9 * static_cast<double>(std::clock() - computed_start) / CLOCKS_PER_SEC;
      const double wall = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
      const auto keep = [&](double& least, double ns) { least = std::min(least, ns / static_cast<double>(ticks)); };
      keep(fastest.wall[threads - 1], wall);
      keep(fastest.computed[threads - 1], computed);
    }
  return fastest;
}

inline void print_threads(double seconds) {
  const char* separator = "";
  const auto print = [&](const char* what, const char* solver, const Threads& ns) {
    std::printf(
        "%s\n    {\"what\": \"%s\", \"solver\": \"%s\", \"one_ns\": %.4g, \"two_ns\": %.4g, \"one_computed_ns\": %.4g, "
        "\"two_computed_ns\": %.4g}",
        separator, what, solver, ns.wall[0], ns.wall[1], ns.computed[0], ns.computed[1]);
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
