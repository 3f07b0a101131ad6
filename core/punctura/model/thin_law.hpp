// K06 section 2.1: an infinitely thin membrane, crossed along its normal.
#pragma once

#include "punctura/model/lane.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/needle.hpp"
#include "punctura/model/piecewise_band.hpp"

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

/// phi_I = -A_I (q + Q), phi_O = A_O (q + Q) on [0, X]; -F and F beyond; 0 before. K06 (13) and (14).
///
/// The thickness of the membrane is not read. Parameters must have passed check() (model/validity.hpp).
template <typename Scalar_>
class BasicThinLaw {
 public:
  using Scalar = Scalar_;

  BasicThinLaw(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane) noexcept
      : constants_(needle, membrane) {
    const auto& [X, A_I, A_O, Q, F] = constants_;
    pieces_.breaks = {0, X};
    pieces_.pieces[1] = {0, {-A_I * Q, -A_I, 0}, {A_O * Q, A_O, 0}};
    pieces_.pieces[2] = {X, {-F, 0, 0}, {F, 0, 0}};
  }

  /// The band at depth q (m), N.
  Band<Scalar> band(Scalar q) const noexcept { return pieces_.band(q); }

  const PiecewiseBand<Scalar, 3>& pieces() const noexcept { return pieces_; }
  const LawConstants<Scalar>& constants() const noexcept { return constants_; }

 private:
  LawConstants<Scalar> constants_;
  PiecewiseBand<Scalar, 3> pieces_{};
};

using ThinLaw = BasicThinLaw<double>;
using ThinLawF = BasicThinLaw<float>;

}  // namespace punctura
