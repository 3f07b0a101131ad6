// Trials of proxies on a line, and what is measured of them.
#pragma once

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "../timing.hpp"
#include "punctura/lab/plant/noise.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura_runtime/batch/line_batch.hpp"

namespace punctura::bench_batch {

inline constexpr double period = 1 / 1600.0;

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

/// The contestants of a row, as JSON.
inline void print(const std::vector<Result>& results) {
  for (const Result& r : results)
    std::printf(
        "%s\n      \"%s\": {\"median_ns\": %.4g, \"fastest_ns\": %.4g, \"lower_quartile_ns\": %.4g, "
        "\"upper_quartile_ns\": %.4g, \"times_faster\": %.4g}",
        &r == &results.front() ? "" : ",", r.name.c_str(), r.ns.median, r.ns.fastest, r.ns.lower_quartile,
        r.ns.upper_quartile, r.over_scalar.median);
}

inline const char* name_of(Solver solver) { return solver == Solver::paper ? "paper" : "exact"; }

}  // namespace punctura::bench_batch
