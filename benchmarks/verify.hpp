// Verifies results before the timing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "punctura/scene/build.hpp"
#include "work.hpp"

namespace bench {

/// Largest difference, N; infinite if there is a NaN.
inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() && !a.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double d = std::abs(a[i] - b[i]);
    if (!(d <= largest)) largest = std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
  }
  return largest;
}

/// 1e-10 N per membrane in double. In float, the last digit of a depth of 40 mm is 4e-9 m, which g = 2000 N/m turns
/// into 7e-6 N per tick; the state holds the rounding of a few such ticks.
inline double tolerance(const std::string& scalar, std::size_t membranes) {
  return (scalar == "double" ? 1e-10 : 2e-3) * static_cast<double>(membranes);
}

/// The exact solver has no second implementation here, so its result is inserted into K06 (21) and (23). Exits with 3
/// if the residual is above 1e-10 N.
inline void check_exact(punctura::Scene scene, const Motion& motion) {
  scene.servo.low_pass = 0;
  scene.servo.solver = punctura::Solver::exact;
  auto insertion = punctura::build_insertion<double>(scene);
  const double K = scene.coupling.stiffness, B = scene.coupling.damping, T = 1 / scene.servo.rate;
  std::vector<punctura::Vector3d> e_prev(scene.membranes.size(), punctura::Vector3d::Zero());
  double worst = 0;
  for (std::size_t k = 0; k < motion.tip.size(); ++k) {
    insertion.step(punctura::to_vector(motion.tip[k]), punctura::to_vector(motion.axis[k]));
    for (std::size_t i = 0; i < e_prev.size(); ++i) {
      const auto& proxy = (*insertion.k06())[i];
      const punctura::Vector3d coupling = K * proxy.offset() + B * (proxy.offset() - e_prev[i]) / T;  // K06 (21)
      worst = std::max(worst, (proxy.force() - coupling).maxAbs());
      const double f = proxy.axial_force();
      const auto band = proxy.band();
      double beyond = std::max({band.lower - f, f - band.upper, 0.0});  // K06 (23)
      if (proxy.phase() == punctura::Phase::sliding_in) beyond = std::abs(f - band.lower);
      if (proxy.phase() == punctura::Phase::sliding_out) beyond = std::abs(f - band.upper);
      worst = std::max(worst, beyond);
      e_prev[i] = proxy.offset();
    }
  }
  if (!(worst <= 1e-10)) {
    std::fprintf(stderr, "%zu membrane(s), %s: the exact solver misses K06 (21)-(23) by %.3g N\n",
                 scene.membranes.size(), motion.name.c_str(), worst);
    std::exit(3);
  }
}

}  // namespace bench
