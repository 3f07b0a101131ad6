// The profile of a membrane from the curve of its grip.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "punctura/model/lane.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/profile.hpp"
#include "punctura/model/tissue.hpp"

namespace punctura {

/// X, m: the tip length of the tissue, or w / tan(theta).
template <typename Scalar>
constexpr Scalar tip_length(const BasicNeedle<Scalar>& needle, const BasicTissue<Scalar>& tissue) noexcept {
  return tissue.tip_length == 0 ? tip_length(needle) : tissue.tip_length;
}

/// Force along the needle per grip: on the tip while it goes in and out, and on the shaft. From K06 (15).
template <typename Scalar>
struct GripFactors {
  Scalar in, out, shaft;

  constexpr GripFactors(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane) noexcept {
    using namespace lane;
    const Scalar t = tan(needle.tip_angle), mu = membrane.friction;
    in = (2 * mu + (1 - mu * mu) * t) / (1 - mu * t);
    out = (2 * mu - (1 - mu * mu) * t) / (1 + mu * t);
    shaft = 2 * mu;
  }
};

namespace detail {
/// (exp(x) - 1) / x, with all digits also near 0.
template <typename Scalar>
constexpr Scalar exp_ratio(const Scalar& x) noexcept {
  using namespace lane;
  if (x > Scalar(-0.02) && x < Scalar(0.02))
    return 1 + x / 2 * (1 + x / 3 * (1 + x / 4 * (1 + x / 5 * (1 + x / 6 * (1 + x / 7)))));
  return (exp(x) - 1) / x;
}
}  // namespace detail

/// G(y), N: the wall's grip on a needle that opens it by y (m).
template <typename Scalar>
constexpr Scalar grip_at(const BasicMembrane<Scalar>& membrane, const BasicTissue<Scalar>& tissue,
                         const Scalar& y) noexcept {
  if (tissue.grip != GripShape::table) {
    const Scalar linear = membrane.stiffness * y;
    if (tissue.grip == GripShape::linear) return linear + membrane.precompression;
    return linear * detail::exp_ratio(Scalar(tissue.growth * y)) + membrane.precompression;
  }
  const auto& table = tissue.grip_table;
  std::size_t i = 0;
  while (i < table.size() && table[i].opening < y) ++i;
  if (i == 0) return table.front().grip;
  if (i == table.size()) return table.back().grip;
  const auto &a = table[i - 1], &b = table[i];
  return a.grip + (b.grip - a.grip) * ((y - a.opening) / (b.opening - a.opening));
}

/// The chords that replace the curve G(y) for y from 0 to w.
template <typename Scalar>
struct Chords {
  std::array<BasicGripPoint<Scalar>, max_knots - 2> points{};
  std::size_t count = 0;

  constexpr void add(const Scalar& y, const Scalar& grip) noexcept { points[count++] = {y, grip}; }
};

namespace detail {
/// n chords to the exponential grip: denser where it is more curved, so that all have the same error. They are shifted
/// so that their mean error is 0 and the average over a wall has little error. The first chord is shifted only at its
/// far end; its mean error is 0 if it is sqrt(1/2) times as long as the others.
template <typename Scalar>
constexpr Chords<Scalar> exponential_chords(const BasicMembrane<Scalar>& membrane, const BasicTissue<Scalar>& tissue,
                                            const Scalar& w, std::size_t n) noexcept {
  using namespace lane;
  Chords<Scalar> chords;
  const Scalar b = tissue.growth, rise = exp(b * w / 2) - 1;
  Scalar area(0);                             // of chords minus curve, N m
  const auto shorter = Lane<Scalar>(0.2929);  // 1 - sqrt(1/2)
  for (std::size_t j = 0; j <= n; ++j) {
    const Scalar share = Scalar((static_cast<Lane<Scalar>>(j) - shorter) / (static_cast<Lane<Scalar>>(n) - shorter));
    const Scalar y = j == 0 ? Scalar(0) : j == n ? w : Scalar(2 / b * log(1 + share * rise));
    const Scalar grip = grip_at(membrane, tissue, y);
    if (j > 0) {
      const auto& before = chords.points[j - 1];
      area += (grip + before.grip) / 2 * (y - before.opening);
    }
    chords.add(y, grip);
  }
  const Scalar kappa = membrane.stiffness, c = membrane.precompression;
  area -= c * w + kappa * (w * exp_ratio(Scalar(b * w)) - w) / b;
  const Scalar moved = w - chords.points[1].opening / 2;  // half of the first chord's area moves
  for (std::size_t j = 1; j <= n; ++j) chords.points[j].grip -= area / moved;
  return chords;
}

template <typename Scalar>
constexpr Chords<Scalar> chords_of(const BasicMembrane<Scalar>& membrane, const BasicTissue<Scalar>& tissue,
                                   const Scalar& w, std::size_t n) noexcept {
  Chords<Scalar> chords;
  if (tissue.grip == GripShape::exponential && n > 1) return exponential_chords(membrane, tissue, w, n);
  chords.add(Scalar(0), grip_at(membrane, tissue, Scalar(0)));
  if (tissue.grip == GripShape::table)
    for (const auto& point : tissue.grip_table)
      if (point.opening > 0 && point.opening < w) chords.add(point.opening, point.grip);
  chords.add(w, grip_at(membrane, tissue, w));
  return chords;
}

/// The largest error of the average over a wall of thickness H, N, if these chords replace the grip. It belongs to G:
/// the force has it times GripFactors::in. X: m.
///
/// The error of G bounds it, and so does the range of the error's integral over H.
template <typename Scalar>
constexpr Scalar average_error(const Chords<Scalar>& chords, const BasicMembrane<Scalar>& membrane,
                               const BasicTissue<Scalar>& tissue, const Scalar& w, const Scalar& X) noexcept {
  using namespace lane;
  if (tissue.grip != GripShape::exponential) return Scalar(0);
  constexpr auto samples = Lane<Scalar>(32);  // per chord
  Scalar largest(0), integral(0), lowest(0), highest(0);
  for (std::size_t j = 1; j < chords.count; ++j) {
    const auto &a = chords.points[j - 1], &b = chords.points[j];
    const Scalar step = (b.opening - a.opening) / samples, slope = (b.grip - a.grip) / (b.opening - a.opening);
    Scalar before = a.grip - grip_at(membrane, tissue, a.opening);
    largest = max(largest, max(before, Scalar(-before)));
    for (auto i = Lane<Scalar>(1); i <= samples; ++i) {
      const Scalar y = a.opening + step * i;
      const Scalar now = a.grip + slope * (step * i) - grip_at(membrane, tissue, y);
      largest = max(largest, max(now, Scalar(-now)));
      integral += (before + now) / 2 * step;
      lowest = min(lowest, integral);
      highest = max(highest, integral);
      before = now;
    }
  }
  largest *= Scalar(1.05);  // for errors between two samples
  const Scalar H = membrane.thickness;
  if (!(H > 0)) return largest;
  return min(largest, Scalar((highest - lowest) * Scalar(1.05) * X / (w * H)));
}

/// A force that -Phi_I reaches, N, along the normal: with the tip's end at the far face, or on the shaft alone.
template <typename Scalar>
constexpr Scalar reached_force(const Chords<Scalar>& chords, const GripFactors<Scalar>& factor,
                               const BasicMembrane<Scalar>& membrane, const BasicTissue<Scalar>& tissue,
                               const Scalar& w, const Scalar& X) noexcept {
  using namespace lane;
  const Scalar H = membrane.thickness, full = chords.points[chords.count - 1].grip;
  const Scalar shaft = factor.shaft * tissue.tail_floor * full;
  if (!(H > 0)) return max(shaft, Scalar(factor.in * full));
  const Scalar from = H < X ? Scalar(w - w * H / X) : Scalar(0);  // the opening at the near face
  Scalar area(0);
  for (std::size_t j = 1; j < chords.count; ++j) {
    const auto &a = chords.points[j - 1], &b = chords.points[j];
    if (!(b.opening > from)) continue;
    const Scalar begin = max(a.opening, from);
    const Scalar grip = a.grip + (b.grip - a.grip) * ((begin - a.opening) / (b.opening - a.opening));
    area += (grip + b.grip) / 2 * (b.opening - begin);
  }
  return max(shaft, Scalar(factor.in * area * X / (w * H)));
}
}  // namespace detail

inline constexpr std::size_t most_chords = 28;
/// The largest error of Phi, as a fraction of its largest force, that chords may have.
inline constexpr double most_chord_error = 1e-4;

/// A profile that replaces a curve, and the largest error of Phi_I or Phi_O that this makes for a needle along the
/// normal, N. At another angle it is at most 1 / cos(beta) times as large.
template <typename Scalar>
struct ProfileOfCurve {
  BasicProfile<Scalar> profile;
  Scalar error;
  bool follows;  ///< the error is at most most_chord_error of the largest force
};

/// The profile of a membrane of tissue. tissue.profile is not read.
///
/// On the tip phi_I = -in G(y) and phi_O = out G(y), with y = w q / X, m. On the shaft -2 mu G(w) and 2 mu G(w), which
/// the tail lowers. The exponential grip gets as few chords as keep the error below most_chord_error, at most 28, or
/// `chords` of them if that is not 0: then the profile is a smooth function of the parameters, and its error is not
/// computed.
template <typename Scalar>
constexpr ProfileOfCurve<Scalar> profile_of(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane,
                                            const BasicTissue<Scalar>& tissue, std::size_t chords = 0) noexcept {
  const GripFactors<Scalar> factor(needle, membrane);
  const Scalar w = needle.diameter, X = tip_length(needle, tissue);
  const Scalar full = grip_at(membrane, tissue, w);
  Chords<Scalar> curve;
  Scalar error(0);
  bool follows = false;
  for (const std::size_t n : {1u, 4u, 8u, 14u, 20u, 28u}) {
    curve = detail::chords_of(membrane, tissue, w, chords > 0 ? std::min(chords, most_chords) : n);
    if (chords > 0) break;
    error = detail::average_error(curve, membrane, tissue, w, X);
    const Scalar reached = detail::reached_force(curve, factor, membrane, tissue, w, X);
    follows = !(error * factor.in > Scalar(most_chord_error) * reached);
    if (follows) break;
  }
  BasicProfile<Scalar> profile;
  for (std::size_t j = 0; j < curve.count; ++j) {
    const auto& [y, grip] = curve.points[j];
    profile.add(j + 1 < curve.count ? Scalar(X * (y / w)) : X, -factor.in * grip, factor.out * grip);
  }
  const Scalar shaft = factor.shaft * full, end = shaft * tissue.tail_floor;
  if (tissue.tail_length > 0) {
    profile.add(X, -shaft, shaft);
    if (tissue.tail_floor < 1) profile.add(X + tissue.tail_length, -end, end);
  } else {
    profile.add(X, -end, end);
  }
  return {profile, error * factor.in, follows};
}

}  // namespace punctura
