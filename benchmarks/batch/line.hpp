// Proxies on a line: the core tick by tick, and each instruction set.
#pragma once

#include <cstdlib>
#include <cstring>

#include "punctura/proxy/proxy_1d.hpp"
#include "work.hpp"

namespace punctura::bench_batch {

/// The scalar core first, then each instruction set. Exits with 3 if one bit of a force differs.
inline std::vector<Result> measure_line(Work& work, Solver solver, double seconds) {
  std::vector<Proxy1d<ThickLaw>> start;
  batch::LineBatch batch(period, solver);
  for (std::size_t i = 0; i < work.trials; ++i) {
    start.emplace_back(work.laws[i], work.couplings[i], period, solver);
    batch.add(work.laws[i].pieces(), work.couplings[i]);
  }
  std::vector<double> scalar(work.force.size());
  auto proxies = start;
  std::vector<bench::Contestant> contestants{{"scalar", [&] {
                                                proxies = start;
                                                for (std::size_t k = 0; k < work.ticks; ++k)
                                                  for (std::size_t i = 0; i < work.trials; ++i)
                                                    scalar[k * work.trials + i] =
                                                        proxies[i].step(work.depth[k * work.trials + i]);
                                              }}};
  const auto n = static_cast<std::ptrdiff_t>(work.trials);
  for (const batch::LineCode* code : batch::line_codes())
    contestants.push_back({code->name, [&, code] {
                             batch.reset();
                             batch::RunOptions options;
                             options.threads = 1;  // and no watch: in this thread, whose time is measured
                             options.code = code;
                             batch.run(work.ticks, {work.depth.data(), n, 1}, {work.force.data(), n, 1}, options);
                           }});
  contestants[0].run();
  for (std::size_t i = 1; i < contestants.size(); ++i) {
    contestants[i].run();
    if (std::memcmp(scalar.data(), work.force.data(), scalar.size() * sizeof(double)) == 0) continue;
    std::fprintf(stderr, "%s: a force differs from that of the scalar core\n", contestants[i].name.c_str());
    std::exit(3);
  }
  const bench::Times times = bench::time_against_each_other(contestants, work.ticks * work.trials, seconds);
  std::vector<Result> results;
  for (std::size_t i = 0; i < contestants.size(); ++i)
    results.push_back({contestants[i].name, times.spreads[i], bench::ratio(times.rounds[0], times.rounds[i])});
  return results;
}

}  // namespace punctura::bench_batch
