// A wall of measured tissue as slices, each with its own memory: the oracle of TissueBand.
#pragma once

#include <algorithm>
#include <vector>

#include "random_tissue.hpp"

namespace punctura::test {

/// K06 (16) by quadrature over the slices of a wall. A slice at depth s (m, along the needle) sees the tip at q - s.
///
/// A slice that the tip reached in an insertion that has ended has a hole, as deep as the tip was in the slice. If that
/// is X or more, the whole slice is a hole.
class Slices {
 public:
  explicit Slices(const TissueCase& c)
      : profile_(c.tissue.profile.empty() ? profile_of(c.needle, c.membrane, c.tissue).profile
                                          : Profile(c.tissue.profile)),
        H_(c.membrane.thickness),
        U_(c.path_length()),
        cos_beta_(std::cos(c.obliquity)),
        X_(punctura::tip_length(c.needle, c.tissue)),
        cutting_(c.tissue.cutting),
        kept_(1 - c.tissue.set) {}

  void reach(double depth) { now_ = std::max(now_, depth); }
  void leave() {
    before_.push_back(now_);
    now_ = 0;
  }

  Band<double> band(double q) const {
    if (H_ == 0) {
      const Band<double> one = slice(0, q);
      return {one.lower / cos_beta_, one.upper / cos_beta_};
    }
    std::vector<double> ends{0, U_, q, q - X_};
    for (const Knot& knot : profile_.used()) ends.push_back(q - knot.depth);
    for (const double depth : before_) ends.insert(ends.end(), {depth, depth - X_});
    for (double& end : ends) end = std::clamp(end, 0.0, U_);
    std::sort(ends.begin(), ends.end());
    Band<double> sum{0, 0};
    for (std::size_t i = 1; i < ends.size(); ++i) {  // the midpoint rule is exact between the ends
      const double width = ends[i] - ends[i - 1];
      const Band<double> one = slice(ends[i - 1] + width / 2, q);
      sum.lower += one.lower * width;
      sum.upper += one.upper * width;
    }
    return {sum.lower / H_, sum.upper / H_};
  }
  /// Whether the band may jump at this depth (m).
  bool is_front(double q) const {
    for (const double depth : before_)
      if (std::abs(q - depth) < 1e-9) return true;
    return std::abs(q - now_) < 1e-9 || (H_ == 0 && std::abs(q - X_) < 1e-9);
  }

 private:
  Band<double> slice(double s, double q) const {
    Band<double> band = profile_at(profile_, q - s);
    double hole = 0, cut = now_ - s;
    for (const double depth : before_) {
      hole = std::max(hole, depth - s);
      cut = std::max(cut, depth - s);
    }
    if (hole >= X_ || q - s <= hole) band = {kept_ * band.lower, kept_ * band.upper};
    if (q - s > std::max(cut, 0.0) && q - s < X_) band.lower -= cutting_;
    return band;
  }

  Profile profile_;
  double H_, U_, cos_beta_, X_, cutting_, kept_;
  double now_ = 0;
  std::vector<double> before_;
};

}  // namespace punctura::test
