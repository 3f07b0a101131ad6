// Random profiles: the force of a thin wall, with straight lines between knots.
#pragma once

#include <algorithm>

#include "punctura/model/piecewise_band.hpp"
#include "punctura/model/profile.hpp"
#include "random_law.hpp"

namespace punctura::test {

/// 1 to 32 knots, gaps from 1 um to 3 mm, some jumps, forces up to 5 N. The upper edge has both signs.
inline Profile random_profile(Noise& noise) {
  Profile profile;
  const auto n = 1 + static_cast<std::size_t>(31.99 * noise.uniform());
  const double most = between_log(noise, 0.01, 5);
  double depth = noise.uniform() < 0.7 ? 0 : between_log(noise, 1e-6, 3e-3);
  for (std::size_t i = 0; i < n; ++i) {
    const double lower = -most * noise.uniform();
    profile.add(depth, lower, lower + most * noise.uniform());
    const bool jumps = i > 0 && noise.uniform() < 0.15 && profile.knots[i - 1].depth < depth;
    if (!jumps) depth += between_log(noise, 1e-6, 3e-3);
  }
  return profile;
}

/// A profile that resists more and more, then drops to a plateau, like K06's: convex and monotone up to its end.
inline Profile random_convex_profile(Noise& noise) {
  Profile profile;
  const auto n = 2 + static_cast<std::size_t>(28 * noise.uniform());
  double depth = 0, force = between(noise, 0, 0.3), slope = between_log(noise, 10, 300);
  for (std::size_t i = 0; i < n; ++i) {
    profile.add(depth, -force, 0.3 * force);
    const double step = between_log(noise, 3e-5, 5e-4);
    slope *= 1 + 0.5 * noise.uniform();
    depth += step;
    force = std::min(force + slope * step, 20.0);
  }
  const double end = profile.knots[n - 1].depth, peak = -profile.knots[n - 1].lower;
  profile.add(end, -0.6 * peak, 0.6 * peak);
  return profile;
}

inline double end_of(const Profile& profile) { return profile.knots[profile.count - 1].depth; }

/// The largest force of a profile, N.
inline double largest(const Profile& profile) {
  double most = 0;
  for (const Knot& knot : profile.used()) most = std::max({most, std::abs(knot.lower), std::abs(knot.upper)});
  return most;
}

/// The profile at depth q. At a jump: the value in front of it.
inline Band<double> profile_at(const Profile& profile, double q) {
  const auto knots = profile.used();
  if (q < knots[0].depth) return {0, 0};
  std::size_t i = 0;
  while (i + 1 < knots.size() && knots[i + 1].depth < q) ++i;
  if (i + 1 == knots.size()) return {knots[i].lower, knots[i].upper};
  const double t = (q - knots[i].depth) / (knots[i + 1].depth - knots[i].depth);
  return {(1 - t) * knots[i].lower + t * knots[i + 1].lower, (1 - t) * knots[i].upper + t * knots[i + 1].upper};
}

}  // namespace punctura::test
