// The force on a device at rest in a membrane with a sticking needle, while its encoders dither.
#pragma once

#include <algorithm>

#include "punctura/lab/plant/noise.hpp"
#include "rig.hpp"

namespace bench {

enum class Dither { toggle, two, three };  ///< alternately n, n+1; randomly n or n+1; randomly n-1, n or n+1
enum class Axes { along, across, all };

inline double dither(Dither kind, int k, punctura::Noise& noise) {
  const double u = noise.uniform();
  if (kind == Dither::toggle) return k % 2 * count;
  return kind == Dither::two ? (u < 0.5 ? 0 : count) : (std::floor(3 * u) - 1) * count;
}

struct RestNoise {
  double norm, along;  ///< rms of f(k) - f(k-1), N: of the vector, and of its component along the needle
};

/// Moves in to 12 mm and out by `back`, all through the encoder, then rests 2 s. The last 1.5 s are evaluated.
inline RestNoise rest_noise(const Method& method, Dither kind, Axes axes, punctura::Solver solver, double back = 1e-3) {
  const Filter filter = method.make();
  auto model = bare_model(1e-3, solver);
  punctura::Noise noise(3);
  const auto force = [&](const Vector3d& p) { return model.step(filter(p), down); };
  double y = 2e-3;
  for (; y > -12e-3; y -= 20e-3 * T) force({0, encoder(y), 0});
  for (const double end = y + back; y < end; y += 5e-3 * T) force({0, encoder(y), 0});
  const Vector3d rest(0, encoder(y), 0);
  for (int k = 0; k < 400; ++k) force(rest);

  Vector3d previous = model.force();
  double norm = 0, along = 0;
  for (int k = 0; k < 3200; ++k) {
    Vector3d p = rest;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = dither(kind, k, noise);
      if (axes == Axes::all || (i == 1) == (axes == Axes::along)) p[i] += d;
    }
    const Vector3d now = force(p), change = now - previous;
    if (k >= 800) {
      norm += change.squaredNorm() / 2400;
      along += change[1] * change[1] / 2400;
    }
    previous = now;
  }
  return {std::sqrt(norm), std::sqrt(along)};
}

/// Force lost during 2 s of dither if the needle came to rest on an edge of the band, N.
inline double creep(const Method& method, Dither kind) {
  const Filter filter = method.make();
  auto model = bare_model(1e-3, punctura::Solver::exact);
  punctura::Noise noise(3);
  double y = 2e-3;
  for (; y > -12e-3; y -= 20e-3 * T) model.step(filter({0, encoder(y), 0}), down);
  const double before = model.force()[1];
  for (int k = 0; k < 3200; ++k) model.step(filter({0, encoder(y) + dither(kind, k, noise), 0}), down);
  double after = 0;
  for (int k = 0; k < 320; ++k) after += model.step(filter({0, encoder(y) + dither(kind, k, noise), 0}), down)[1] / 320;
  return before - after;
}

}  // namespace bench
