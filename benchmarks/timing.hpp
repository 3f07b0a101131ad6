// Compares the run times of several implementations on a machine that is not idle.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace bench {

/// A compiler barrier: memory counts as read and written, so the results so far are not optimised away.
inline void keep_memory() { asm volatile("" ::: "memory"); }

/// Processor time of this thread, ns. Time that other threads use does not count.
inline double computed_ns() {
#ifdef CLOCK_THREAD_CPUTIME_ID
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
#else
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
#endif
}

struct Contestant {
  std::string name;
  std::function<void()> run;  ///< does the whole work once, from the same initial state
  std::function<std::vector<double>()>
      forces{};  ///< forces of the last run, N, for the comparison before the measurement
};

struct Spread {
  double median, lower_quartile, upper_quartile, fastest;
};

/// The quantile of sorted numbers, interpolated.
inline double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const std::size_t i = static_cast<std::size_t>(at);
  const std::size_t j = std::min(i + 1, sorted.size() - 1);
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[j] - sorted[i]);
}

inline Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75), values.front()};
}

/// The ratio per round, because a disturbance slows both in the same round. (`fastest` is then the smallest ratio.)
inline Spread ratio(std::vector<double> times, const std::vector<double>& reference) {
  for (std::size_t i = 0; i < times.size(); ++i) times[i] /= reference[i];
  return spread(std::move(times));
}

struct Times {
  std::vector<Spread> spreads;              ///< nanoseconds per tick, one per contestant
  std::vector<std::vector<double>> rounds;  ///< the values of each round, one row per contestant
};

/// Runs rounds. In each round every contestant runs once, in a new order, so that disturbances affect all equally.
/// Ends after `seconds`, with at least `least` and at most `most` rounds.
inline Times time_against_each_other(const std::vector<Contestant>& contestants, std::size_t ticks, double seconds,
                                     std::size_t least = 21, std::size_t most = 401) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::size_t> order(contestants.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::mt19937 random(1);

  Times times{{}, std::vector<std::vector<double>>(contestants.size())};
  for (const auto& contestant : contestants) contestant.run();  // warm up caches and branch predictors
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (std::size_t round = 0; round < most && (round < least || Clock::now() < end); ++round) {
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t i : order) {
      const double start = computed_ns();
      contestants[i].run();
      keep_memory();
      times.rounds[i].push_back((computed_ns() - start) / static_cast<double>(ticks));
    }
  }
  for (const auto& rounds : times.rounds) times.spreads.push_back(spread(rounds));
  return times;
}

}  // namespace bench
