// What K06's laws take from a needle and a membrane.
#pragma once

#include "punctura/model/lane.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/needle.hpp"

namespace punctura {

/// The five numbers in which needle and membrane enter the law, K06 (15).
template <typename Scalar>
struct LawConstants {
  Scalar X;    ///< length of the tip, m
  Scalar A_I;  ///< growth of the resistance while the tip goes in, N/m
  Scalar A_O;  ///< the same while it comes out; negative where the membrane expels the tip, N/m
  Scalar Q;    ///< precompression as a depth, m
  Scalar F;    ///< dry friction of the shaft, N

  LawConstants(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane) noexcept {
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
