// The needle of K06 section 2.
#pragma once

#include <cmath>

namespace punctura {

/// A needle: a wedge of one slanted face, then a shaft (K06 Fig. 1).
template <typename Scalar>
struct BasicNeedle {
  Scalar diameter;   ///< w, m
  Scalar tip_angle;  ///< theta, rad
};

using Needle = BasicNeedle<double>;
using NeedleF = BasicNeedle<float>;

/// Length of the slanted face along the needle, m: X = w / tan(theta). K06 (15)
template <typename Scalar>
Scalar tip_length(const BasicNeedle<Scalar>& needle) noexcept {
  return needle.diameter / std::tan(needle.tip_angle);
}

}  // namespace punctura
