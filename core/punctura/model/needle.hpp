// The needle of K06 section 2.
#pragma once

#include "punctura/model/field.hpp"
#include "punctura/model/lane.hpp"

namespace punctura {

/// A needle: a tip with one slanted face, and a shaft behind it (K06 Fig. 1).
template <typename Scalar>
struct BasicNeedle {
  Scalar diameter = Scalar(not_given);   ///< w, m
  Scalar tip_angle = Scalar(not_given);  ///< theta, rad
};

using Needle = BasicNeedle<double>;
using NeedleF = BasicNeedle<float>;

/// X, the length of the tip along the needle, m: X = w / tan(theta). K06 (15)
template <typename Scalar>
constexpr Scalar tip_length(const BasicNeedle<Scalar>& needle) noexcept {
  using namespace lane;
  return needle.diameter / tan(needle.tip_angle);
}

}  // namespace punctura
