// The needle and the membrane of K06 section 2, and the constants of its laws.
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

/// A membrane: a stack of springs that grip the needle with dry friction. K06 section 2
template <typename Scalar>
struct BasicMembrane {
  Scalar stiffness = Scalar(not_given);       ///< kappa, N/m
  Scalar precompression = Scalar(not_given);  ///< c, N
  Scalar friction = Scalar(not_given);        ///< mu, -
  Scalar thickness = Scalar(not_given);       ///< H, m; 0 gives the thin law
};

using Membrane = BasicMembrane<double>;
using MembraneF = BasicMembrane<float>;

/// The five constants of the thin and the thick law, K06 (15).
template <typename Scalar>
struct LawConstants {
  Scalar X;    ///< length of the tip, m
  Scalar A_I;  ///< slope of -phi_I on the tip, N/m
  Scalar A_O;  ///< slope of phi_O on the tip, N/m; negative if the membrane expels the tip
  Scalar Q;    ///< depth that is equivalent to the precompression, m
  Scalar F;    ///< dry friction of the shaft, N

  constexpr LawConstants(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane) noexcept {
    using namespace lane;
    const Scalar t = tan(needle.tip_angle), mu = membrane.friction, kappa = membrane.stiffness;
    X = needle.diameter / t;
    A_I = kappa * t * (2 * mu + (1 - mu * mu) * t) / (1 - mu * t);
    A_O = kappa * t * (2 * mu - (1 - mu * mu) * t) / (1 + mu * t);
    Q = membrane.precompression / (kappa * t);
    F = 2 * mu * (kappa * needle.diameter + membrane.precompression);
  }
};

}  // namespace punctura
