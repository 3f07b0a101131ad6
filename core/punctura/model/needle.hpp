// The needle of K06 section 2.
#pragma once

namespace punctura {

/// A needle: a wedge of one slanted face, then a shaft (K06 Fig. 1).
template <typename Scalar>
struct BasicNeedle {
  Scalar diameter;   ///< w, m
  Scalar tip_angle;  ///< theta, rad
};

using Needle = BasicNeedle<double>;
using NeedleF = BasicNeedle<float>;

}  // namespace punctura
