// Random motions of a device's tip along one line: strokes, stops, noise and jumps.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "punctura/proxy/coupling.hpp"
#include "random_law.hpp"

namespace punctura::test {

/// n depths (m) between -0.3 and 1.3 times `reach`: moves at constant speed, rests, tremor and some jumps.
inline std::vector<double> random_motion(Noise& noise, std::size_t n, double reach, double period) {
  std::vector<double> p;
  double x = -0.3 * reach;
  p.push_back(x);  // in front of the surface, also if the first move is fast
  while (p.size() < n) {
    const double goal = between(noise, -0.3, 1.3) * reach;
    const double speed = between_log(noise, 1e-3, 0.3);
    const double kind = noise.uniform();
    const auto ticks = static_cast<std::size_t>(between(noise, 5, 80));
    for (std::size_t i = 0; i < ticks && p.size() < n; ++i) {
      if (kind < 0.6) x += std::clamp(goal - x, -speed * period, speed * period);
      if (kind > 0.9) x += 1e-5 * noise.normal();
      p.push_back(x);
    }
    if (kind > 0.6 && kind < 0.63) x = goal;
  }
  return p;
}

inline BasicCoupling<double> random_coupling(Noise& noise) {
  return {between_log(noise, 100, 3000), noise.uniform() < 0.1 ? 0 : between_log(noise, 0.01, 10)};
}

}  // namespace punctura::test
