// Random membranes of measured tissue.
#pragma once

#include <cmath>

#include "punctura/model/tissue_law.hpp"
#include "random_profile.hpp"

namespace punctura::test {

struct TissueCase : LawCase {
  Tissue tissue;

  TissueLaw law() const noexcept { return {needle, membrane, tissue, std::cos(obliquity)}; }
  double path_length() const noexcept { return membrane.thickness / std::cos(obliquity); }
  /// Behind this depth, m, the law is constant.
  double reach() const noexcept {
    const auto pieces = law().pieces();
    return pieces.breaks[pieces.count - 2];
  }
};

/// Every addition is on: a curved or a measured grip or a profile, a tip length, a tail, cutting and a set.
inline TissueCase random_tissue(Noise& noise, double thinnest = 1e-4) {
  for (;;) {
    TissueCase c{random_law(noise, thinnest), {}};
    Tissue& t = c.tissue;
    const double w = c.needle.diameter, kind = noise.uniform();
    t.tip_length = between(noise, 0.3, 2) * tip_length(c.needle);
    t.tail_length = between_log(noise, 1e-5, 5e-3);
    t.tail_floor = noise.uniform();
    t.cutting = between_log(noise, 1e-3, 2);
    t.set = noise.uniform();
    if (kind < 0.4) {
      t.grip = GripShape::exponential;
      t.growth = between(noise, -1, 1) / w;
    } else if (kind < 0.7) {
      t.grip = GripShape::table;
      double grip = between(noise, 0, 0.3);
      const auto points = 2 + static_cast<int>(20 * noise.uniform());
      for (int i = 0; i < points; ++i, grip += between(noise, 0, 0.2))
        t.grip_table.push_back({1.1 * w * i / points, grip});
    } else {
      const auto profile = random_profile(noise);
      for (const Knot& knot : profile.used()) t.profile.push_back(knot);
      t.profile[0].depth = 0;
    }
    std::vector<Problem> problems;
    if (check(t, "", problems) && check_curve(c.needle, c.membrane, t, "", problems)) return c;
  }
}

/// A soft organ's capsule: a needle of 1.27 mm, a wall of half a millimetre, nothing added yet.
inline TissueCase plain_tissue() { return {{{1.27e-3, 0.3}, {400, 0.1, 0.2, 0.5e-3}, 0}, {}}; }

}  // namespace punctura::test
