// Batches of proxies on a line, and of trials with a simulated hand, against the core stepped tick by tick, in one
// program and over the same trials.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <numbers>

#include "../timing.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/plant/experiment.hpp"
#include "punctura/plant/noise.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura_runtime/batch/line_batch.hpp"
#include "punctura_runtime/batch/scene_batch.hpp"

namespace {

using namespace punctura;

constexpr double period = 1 / 1600.0;

/// Trials through K06's membrane: thickness, friction and coupling differ, and each hand has its own stroke and tremor.
struct Work {
  std::size_t trials, ticks;
  std::vector<ThickLaw> laws;
  std::vector<Coupling> couplings;
  std::vector<double> depth, force;  ///< (ticks, trials)

  Work(std::size_t n, std::size_t k) : trials(n), ticks(k), depth(n * k), force(n * k) {
    Noise noise(7);
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(); };
    for (std::size_t i = 0; i < n; ++i) {
      laws.emplace_back(Needle{1.08e-3, 0.28}, Membrane{570, 0.41, between(0.1, 0.3), between(0.3e-3, 1e-3)});
      couplings.push_back({between(300, 500), between(0.5, 1.5)});
      const double stroke = between(0.6, 1), start = between(0, 1), hertz = between(8, 12), phase = between(0, 6);
      for (std::size_t j = 0; j < k; ++j) {
        const double t = period * static_cast<double>(j);
        const double u = (t + start) / stroke, share = u - std::floor(u);
        const double s = share < 0.5 ? 2 * share : 2 - 2 * share;
        const double tremor = 5e-5 * std::sin(2 * std::numbers::pi * hertz * t + phase);
        depth[j * n + i] = -2e-3 + 9e-3 * s * s * s * (10 - 15 * s + 6 * s * s) + tremor;
      }
    }
  }
};

struct Result {
  std::string name;
  bench::Spread ns, over_scalar;  ///< per trial and tick; scalar time / this time
};

/// The scalar core first, then each instruction set. Exits with 3 if one bit of a force differs.
std::vector<Result> measure(Work& work, Solver solver, double seconds) {
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

/// Trials of a second at 1600 Hz with a simulated hand, through a wall of K06 or of measured tissue.
batch::SceneBatch hands(std::size_t trials, Solver solver, bool tissue) {
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

/// Experiment tick by tick without any summary, then batches with theirs. Exits with 3 if the work of a trial differs
/// in one bit.
std::vector<Result> measure_hands(std::size_t trials, Solver solver, bool tissue, double seconds) {
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

/// ns of the same work with 1 and with 2 threads, in turn: the fastest round of each.
struct Threads {
  double wall[2] = {1e300, 1e300};
  double computed[2] = {1e300, 1e300};  ///< processor time of all threads
};
Threads measure_threads(std::size_t ticks, double seconds, const std::function<void(const batch::RunOptions&)>& run) {
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

void print_threads(double seconds) {
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
    const char* name = solver == Solver::paper ? "paper" : "exact";
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

void print(const std::vector<Result>& results) {
  for (const Result& r : results)
    std::printf(
        "%s\n      \"%s\": {\"median_ns\": %.4g, \"fastest_ns\": %.4g, \"lower_quartile_ns\": %.4g, "
        "\"upper_quartile_ns\": %.4g, \"times_faster\": %.4g}",
        &r == &results.front() ? "" : ",", r.name.c_str(), r.ns.median, r.ns.fastest, r.ns.lower_quartile,
        r.ns.upper_quartile, r.over_scalar.median);
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 2;
  for (int i = 1; i + 1 < argc; i += 2)
    if (std::string(argv[i]) == "--seconds") seconds = std::atof(argv[i + 1]);
  std::printf("{\n  \"compiler\": \"%s\", \"flags\": \"%s\", \"rows\": [", BENCH_COMPILER, BENCH_FLAGS);
  bool first = true;
  for (const auto& [trials, ticks] : {std::pair<std::size_t, std::size_t>{32, 4000}, {1024, 800}, {100'000, 64}}) {
    Work work(trials, ticks);
    for (const Solver solver : {Solver::paper, Solver::exact}) {
      std::printf("%s\n    {\"solver\": \"%s\", \"trials\": %zu, \"ticks\": %zu, \"contestants\": {", first ? "" : ",",
                  solver == Solver::paper ? "paper" : "exact", trials, ticks);
      first = false;
      print(measure(work, solver, seconds));
      std::printf("}}");
      std::fflush(stdout);
      std::fprintf(stderr, ".");
    }
  }
  std::printf("\n  ], \"hands\": [");
  first = true;
  for (const Solver solver : {Solver::paper, Solver::exact})
    for (const bool tissue : {false, true}) {
      std::printf("%s\n    {\"solver\": \"%s\", \"wall\": \"%s\", \"contestants\": {", first ? "" : ",",
                  solver == Solver::paper ? "paper" : "exact", tissue ? "tissue" : "K06");
      first = false;
      print(measure_hands(64, solver, tissue, seconds));
      std::printf("}}");
      std::fprintf(stderr, ".");
    }
  std::printf("\n  ], \"threads\": [");
  print_threads(seconds);
  std::printf("\n  ],\n  \"bytes_per_trial\": %zu\n}\n", sizeof(batch::LineBlock) / batch::block_lanes);
  std::fprintf(stderr, "\n");
}
