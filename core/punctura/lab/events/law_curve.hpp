// The curves of a law, for plots.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "punctura/lab/events/crossing.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/scene/scene.hpp"

namespace punctura {

/// Phi_I and Phi_O at ascending depths. Each break has points on both sides, so that a jump is drawn as a jump.
struct LawCurve {
  std::vector<double> depth;         ///< m
  std::vector<double> lower, upper;  ///< N
};

/// The curve of a law with these pieces.
template <typename Pieces>
LawCurve law_curve(const Pieces& law) {
  constexpr int points = 16;                      // per piece: a quadratic then looks smooth
  constexpr double in_front = 0.1, behind = 0.3;  // margins of the curve, as fractions of the last break
  const std::size_t last = detail::last_break(law);
  const double through = law.breaks[last];
  LawCurve curve;
  curve.depth = {-in_front * through, (1 + behind) * through};
  for (std::size_t k = 0; k <= last; ++k) {
    const double at = law.breaks[k];
    curve.depth.insert(curve.depth.end(), {std::nextafter(at, -1.0), at, std::nextafter(at, 1.0)});
    for (int i = 1; k > 0 && i < points - 1; ++i)
      curve.depth.push_back(law.breaks[k - 1] + i * ((at - law.breaks[k - 1]) / (points - 1)));
  }
  std::sort(curve.depth.begin(), curve.depth.end());
  curve.depth.erase(std::unique(curve.depth.begin(), curve.depth.end()), curve.depth.end());
  for (const double depth : curve.depth) {
    const auto band = law.band(depth);
    curve.lower.push_back(band.lower);
    curve.upper.push_back(band.upper);
  }
  return curve;
}

/// The law of one membrane of a scene for one direction of the needle.
struct MembraneLaw {
  double far_face;  ///< depth at which the tip's point is behind the membrane, m: U = H / cos(beta), K06 (17)
  double through;   ///< depth at which the whole tip is behind it, m: X + U, K06 (18)
  LawCurve curve;
};

/// obliquity: beta, rad, between the needle and the inward normal; less than pi / 2.
inline MembraneLaw membrane_law(const Scene& scene, std::size_t membrane, double obliquity) {
  const PlacedMembrane& placed = scene.membranes[membrane];
  const double cos_beta = std::cos(obliquity), far_face = placed.membrane.thickness / cos_beta;
  const TissueLaw law(scene.needle, placed.membrane, placed.tissue, cos_beta);
  return {far_face, detail::passed(law, law.pieces(), far_face), law_curve(law.pieces())};
}

/// The largest obliquity that is drawn, rad, because 1 / cos(beta) grows without bound.
inline constexpr double steepest_drawn = 85 * std::numbers::pi / 180;

/// The angle between the needle and the inward normal of a membrane, rad, from 0 to steepest_drawn. 0 without a
/// direction.
///
/// axis: the direction of the stylus. entered: the direction since entry if the needle is inside, otherwise NaN.
inline double drawn_obliquity(const Scene& scene, const PlacedMembrane& placed, const Vector3d& axis,
                              const Vector3d& entered) noexcept {
  const Vector3d normal = to_vector(placed.inward_normal);
  const Vector3d direction = entered.allFinite() ? entered : scene.direction == Direction::motion ? normal : axis;
  const double cosine = direction.dot(normal) / (normal.norm() * direction.norm());
  if (!std::isfinite(cosine)) return 0;
  return std::min(std::acos(std::clamp(cosine, -1.0, 1.0)), steepest_drawn);
}

}  // namespace punctura
