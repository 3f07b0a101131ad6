// Effects of conditioning on motions: delay, the pop, slow strokes across counts, reversals, sudden stops.
#pragma once

#include <algorithm>
#include <vector>

#include "methods.hpp"
#include "rig.hpp"

namespace bench {

inline double conditioned(const Filter& filter, double y) { return filter({0, y, 0})[1]; }

/// Mean delay of the conditioned position at constant speed, s, over 16 phases of the encoder grid.
inline double delay(const Method& method, double speed) {
  const int ticks = static_cast<int>(std::min(20e-3 / speed, 4.0) / T);
  double sum = 0;
  int n = 0;
  for (int phase = 0; phase < 16; ++phase) {
    const Filter filter = method.make();
    for (int k = 0; k < ticks; ++k) {
      const double x = speed * T * k, y = conditioned(filter, encoder(x, phase / 16.0));
      if (k < ticks / 2) continue;
      sum += (x - y) / speed;
      ++n;
    }
  }
  return sum / n;
}

struct Pop {
  double size;  ///< N: largest force of an insertion minus the mean on the plateau, 2 to 4 mm behind the end of the tip
  double tick;  ///< N: largest decrease within 5 ms behind the end of the slanted face
};

/// One insertion at constant speed.
inline Pop pop(const Filter& filter, double speed, double thickness, punctura::Solver solver, bool ideal,
               double phase) {
  auto model = bare_model(thickness, solver);
  std::vector<double> f;
  double greatest = 0, plateau = 0, fall = 0;
  int n = 0;
  for (double y = 1e-3; y > -9e-3; y -= speed * T) {
    f.push_back(model.step(filter({0, ideal ? y : encoder(y, phase), 0}), down)[1]);
    greatest = std::max(greatest, f.back());
    if (y < -3e-3) fall = std::max(fall, f[f.size() - 9] - f.back());
    if (y > -7e-3) continue;
    plateau += f.back();
    ++n;
  }
  return {greatest - plateau / n, fall};
}

/// The largest relative errors over 5, 10 and 20 mm/s and 16 grid phases, compared with an ideal sensor and K06's
/// filter.
inline Pop pop_error(const Method& method, double thickness, punctura::Solver solver) {
  Pop worst{0, 0};
  const auto keep = [](double& most, double error) {
    if (std::abs(error) > std::abs(most)) most = error;
  };
  for (const double speed : {5e-3, 10e-3, 20e-3}) {
    const Pop right = pop(low_pass(300), speed, thickness, solver, true, 0);
    for (int phase = 0; phase < 16; ++phase) {
      const Pop found = pop(method.make(), speed, thickness, solver, false, phase / 16.0);
      keep(worst.size, found.size / right.size - 1);
      keep(worst.tick, found.tick / right.tick - 1);
    }
  }
  return worst;
}

struct Ripple {
  double tick, worst;  ///< N: rms of f(k) - f(k-1); largest difference from an ideal sensor with K06's filter
};

/// Force between a slow constant motion and a sticking proxy.
inline Ripple ripple(const Method& method, double speed) {
  const Filter filter = method.make(), ideal = low_pass(300);
  double y = 0, z = 0, f = 0, sum = 0, worst = 0;
  constexpr int ticks = 8000, settled = 1600;
  for (int k = 0; k < ticks; ++k) {
    const double x = speed * T * k, y_now = conditioned(filter, encoder(x, 0.3)), z_now = conditioned(ideal, x);
    const double now = -K * y_now - B * (y_now - y) / T, right = -K * z_now - B * (z_now - z) / T;
    if (k >= settled) {
      sum += (now - f) * (now - f) / (ticks - settled);
      worst = std::max(worst, std::abs(now - right));
    }
    y = y_now, z = z_now, f = now;
  }
  return {std::sqrt(sum), worst};
}

/// Width of the hysteresis loop of a slow triangular motion of 1 mm/s, in counts. The turns (30 ms) are left out.
inline double loop_width(const Method& method) {
  const Filter filter = method.make();
  double width = 0;
  int n = 0;
  constexpr int half = 1600, turn = 48;  // 1 mm each way
  for (int k = 0; k < 8 * half; ++k) {
    const int place = k % (2 * half), way = place < half ? 1 : -1;
    const double x = 1e-3 * T * (way > 0 ? place : 2 * half - place), y = conditioned(filter, encoder(x, 0.3));
    if (k < 2 * half || place % half < turn) continue;
    width += 2 * way * (x - y);
    ++n;
  }
  return width / n / count;
}

/// Largest distance from K06's filter on an ideal sensor, in counts, for a stroke of the hand of 2 Hz and 2 mm.
inline double stroke_error(const Method& method) {
  const Filter filter = method.make(), ideal = low_pass(300);
  double worst = 0;
  for (int k = 0; k < 4800; ++k) {
    const double x = 2e-3 * std::sin(2 * std::numbers::pi * 2 * T * k);
    const double error = std::abs(conditioned(filter, encoder(x, 0.3)) - conditioned(ideal, x));
    if (k > 800) worst = std::max(worst, error);
  }
  return worst / count;
}

/// Overshoot of the conditioned position when a motion stops suddenly, in counts.
inline double overshoot(const Method& method, double speed) {
  const Filter filter = method.make();
  double worst = 0, x = 0;
  for (int k = 0; k < 400; ++k) conditioned(filter, encoder(x = speed * T * k, 0.3));
  for (int k = 0; k < 400; ++k) worst = std::max(worst, conditioned(filter, encoder(x, 0.3)) - x);
  return worst / count;
}

}  // namespace bench
