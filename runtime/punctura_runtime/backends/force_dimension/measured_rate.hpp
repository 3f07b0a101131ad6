// The highest rate at which a device can be read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"

namespace punctura::force_dimension {

inline constexpr double for_the_rest = 0.05;  ///< share of a period for all that a tick does beside reading

/// Hz. Reads as fast as possible, without force, and takes the median time between new readings, so that a short delay
/// of the computer has no effect. `unknown` if readings take no time or fail; the first tick then reports why.
template <typename Clock>
double measured_rate(const Api& api, char id, const Clock& clock) {
  constexpr int enough = 50, most = 100'000;
  constexpr std::int64_t time_limit = 200'000'000;  // ns
  std::vector<std::int64_t> took;
  const std::int64_t begin = clock.now();
  std::int64_t last = begin;
  for (int n = 0; n < most && took.size() < enough && last - begin < time_limit; ++n) {
    double x = 0, y = 0, z = 0, frame[3][3] = {};
    const int got = api.read(&x, &y, &z, frame, id);
    if (got < 0) return unknown;
    if (got == time_guard) continue;
    const std::int64_t now = clock.now();
    took.push_back(now - last);
    last = now;
  }
  if (took.empty()) return unknown;
  const auto middle = took.begin() + static_cast<std::ptrdiff_t>(took.size() / 2);
  std::nth_element(took.begin(), middle, took.end());
  return *middle > 0 ? (1 - for_the_rest) * 1e9 / static_cast<double>(*middle) : unknown;
}

}  // namespace punctura::force_dimension
