// The law of K06 section 2.1: an infinitely thin membrane, crossed along its normal.
#pragma once

#include "punctura/model/membrane.hpp"
#include "punctura/model/piecewise_band.hpp"

namespace punctura {

/// The thin law, K06 (13) and (14), N. Depth q in m.
///
/// - q < 0: phi_I = phi_O = 0.
/// - q in [0, X]: phi_I = -A_I (q + Q) and phi_O = A_O (q + Q).
/// - q > X: phi_I = -F and phi_O = F.
///
/// The law ignores the thickness of the membrane. Parameters must have passed check() (model/validity.hpp).
template <typename Scalar_>
class BasicThinLaw {
 public:
  using Scalar = Scalar_;

  constexpr BasicThinLaw(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane) noexcept
      : constants_(needle, membrane) {
    const auto& [X, A_I, A_O, Q, F] = constants_;
    pieces_.breaks = {0, X};
    // Case 1, q < 0: pieces[0] is 0.
    pieces_.pieces[1] = {0, {-A_I * Q, -A_I, 0}, {A_O * Q, A_O, 0}};  // K06 (13), (14), case 2: q in [0, X]
    pieces_.pieces[2] = {X, {-F, 0, 0}, {F, 0, 0}};                   // K06 (13), (14), case 3: q > X
  }

  /// The band at depth q (m), N.
  constexpr Band<Scalar> band(Scalar q) const noexcept { return pieces_.band(q); }

  constexpr const PiecewiseBand<Scalar, 3>& pieces() const noexcept { return pieces_; }
  constexpr const LawConstants<Scalar>& constants() const noexcept { return constants_; }

 private:
  LawConstants<Scalar> constants_;
  PiecewiseBand<Scalar, 3> pieces_{};
};

using ThinLaw = BasicThinLaw<double>;
using ThinLawF = BasicThinLaw<float>;

}  // namespace punctura
