// The constants of K06's laws, computed from a needle and a membrane.
#pragma once

#include "punctura/model/lane.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/needle.hpp"

namespace punctura {

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
