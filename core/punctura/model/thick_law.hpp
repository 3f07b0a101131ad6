// K06 section 2.2: a membrane of thickness H, crossed at an angle beta to its normal.
#pragma once

#include <array>
#include <cstddef>

#include "punctura/model/law_constants.hpp"
#include "punctura/model/piecewise_band.hpp"

namespace punctura {

/// Phi(q) = 1/H * integral of phi from q - U to q, with U = H / cos(beta). K06 (16) to (19).
///
/// At depth q the needle runs through a length U of membrane: a part of it lies on the tip, where phi grows linearly
/// (so its integral is length times phi at the middle), the rest on the shaft, where phi is F. The lengths change their
/// rule at 0, min(U,X), max(U,X) and X + U, which gives the six cases of (18) and (19).
///
/// H = 0 is the limit: the thin law times 1 / cos(beta). Parameters must have passed check() (model/validity.hpp).
template <typename Scalar_>
class BasicThickLaw {
 public:
  using Scalar = Scalar_;
  using Pieces = PiecewiseBand<Scalar, 5>;

  /// obliquity: beta, rad, of pieces() and band().
  BasicThickLaw(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane, Scalar obliquity = 0) noexcept
      : constants_(needle, membrane), H_(membrane.thickness) {
    using namespace lane;
    const Scalar cos_beta = cos(obliquity);
    U_ = H_ / cos_beta;
    pieces_ = pieces(cos_beta);
  }

  /// The law of a needle that enters with n.b = cos_beta > 0.
  Pieces pieces(Scalar cos_beta) const noexcept {
    using namespace lane;
    const Scalar U = H_ / cos_beta;  // K06 (17)
    const Scalar X = constants_.X;
    const auto in = edge(constants_.A_I, U, 1 / cos_beta, -1), out = edge(constants_.A_O, U, 1 / cos_beta, +1);
    Pieces all;
    all.breaks = {0, min(U, X), max(U, X), X + U};
    for (std::size_t i = 1; i < 5; ++i) all.pieces[i] = {all.breaks[i - 1], in[i], out[i]};
    return all;
  }

  const Pieces& pieces() const noexcept { return pieces_; }
  Band<Scalar> band(Scalar q) const noexcept { return pieces_.band(q); }  ///< at depth q (m, along the needle), N
  const LawConstants<Scalar>& constants() const noexcept { return constants_; }
  Scalar thickness() const noexcept { return H_; }    ///< H, m
  Scalar path_length() const noexcept { return U_; }  ///< U, m

 private:
  /// sign * Phi: (18) with A = A_I and sign -1, (19) with A = A_O and sign +1. Each piece is written from its own start: x = q - start.
  /// U_over_H is handed in since H may be 0.
  std::array<Quadratic<Scalar>, 5> edge(Scalar A, Scalar U, Scalar U_over_H, int sign) const noexcept {
    using namespace lane;
    using Piece = Quadratic<Scalar>;
    const auto& [X, A_I, A_O, Q, F] = constants_;
    const auto thin = U <= X;    // all of the membrane fits on the tip
    const Scalar m = min(U, X);  // most membrane that ever lies on the tip
    const Scalar m_over_H = select(thin, U_over_H, X / H_);
    const Scalar shaft_over_H =
        select(thin, Scalar(0), (U - X) / H_);  // membrane on the shaft when the tip begins to leave

    std::array<Piece, 5> phi{};  // phi[0], q < 0: 0
    // q in [U, X]: A U (2q - U + 2Q) / 2H; or q in [X, U]: F (q - X) / H + A X (X + 2Q) / 2H
    phi[2] = {A * m_over_H * (m / 2 + Q), select(thin, A * U_over_H, F / H_), 0};
    // q > X + U: F U / H
    phi[4] = {F * U_over_H, 0, 0};
    // Where H = 0 the surface is met at once, and the far face left at once.
    const auto thick = U > 0;
    // q in [0, min(U,X)]: A q (q + 2Q) / 2H
    phi[1] = select(thick, Piece{0, A * Q / H_, A / (2 * H_)}, phi[2]);
    // q in [max(U,X), X+U]: F (q - X) / H + A (U + X - q)(q - U + X + 2Q) / 2H
    const Piece leaving{A * m_over_H * (X + Q - m / 2) + F * shaft_over_H, (A * (m - X - Q) + F) / H_, -A / (2 * H_)};
    phi[3] = select(thick, leaving, phi[4]);
    if (sign < 0)
      for (auto& piece : phi) piece = {0 - piece.c0, 0 - piece.c1, 0 - piece.c2};  // 0 - x: no negative zero
    return phi;
  }

  LawConstants<Scalar> constants_;
  Scalar H_, U_;
  Pieces pieces_;
};

using ThickLaw = BasicThickLaw<double>;
using ThickLawF = BasicThickLaw<float>;

}  // namespace punctura
