// The law of K06 section 2.2: a membrane of thickness H, crossed at an angle beta to its normal.
#pragma once

#include <array>
#include <cstddef>

#include "punctura/model/law.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/piecewise_band.hpp"

namespace punctura {

/// The thick law, K06 (16) to (19): Phi(q) = 1/H * integral of phi from q - U to q, N, with U = H / cos(beta).
///
/// phi is the thin law. The path of the needle through the membrane has the length U. Part of the membrane lies on
/// the tip. There phi is linear in depth, so its integral is the length times phi at the middle. The rest lies on the
/// shaft, where phi is constant. The formulas of both lengths change at q = 0, min(U, X), max(U, X) and X + U.
/// Therefore (18) and (19) have six cases.
///
/// H = 0 gives the limit, the thin law times 1 / cos(beta). Parameters must have passed check() (model/validity.hpp).
template <typename Scalar_>
class BasicThickLaw {
 public:
  using Scalar = Scalar_;
  using Pieces = PiecewiseBand<Scalar, 5>;

  /// obliquity: beta, rad. pieces() and band() use it.
  constexpr BasicThickLaw(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane,
                          Scalar obliquity = 0) noexcept
      : constants_(needle, membrane), H_(membrane.thickness) {
    using namespace lane;
    const Scalar cos_beta = cos(obliquity);
    U_ = H_ / cos_beta;
    pieces_ = pieces(cos_beta);
  }

  /// The pieces for a needle that enters with n.b = cos_beta > 0.
  constexpr Pieces pieces(Scalar cos_beta) const noexcept {
    using namespace lane;
    const Scalar U = H_ / cos_beta;  // K06 (17)
    const Scalar X = constants_.X;
    const auto in = edge(constants_.A_I, U, 1 / cos_beta, -1), out = edge(constants_.A_O, U, 1 / cos_beta, +1);
    Pieces all;
    all.breaks = {0, min(U, X), max(U, X), X + U};
    for (std::size_t i = 1; i < 5; ++i) all.pieces[i] = {all.breaks[i - 1], in[i], out[i]};
    return all;
  }

  constexpr const Pieces& pieces() const noexcept { return pieces_; }
  constexpr Band<Scalar> band(Scalar q) const noexcept {
    return pieces_.band(q);
  }  ///< at depth q (m, along the needle), N
  constexpr const LawConstants<Scalar>& constants() const noexcept { return constants_; }
  constexpr Scalar thickness() const noexcept { return H_; }    ///< H, m
  constexpr Scalar path_length() const noexcept { return U_; }  ///< U, m

 private:
  /// The pieces of one edge: K06 (18) for A = A_I and sign = -1, K06 (19) for A = A_O and sign = +1.
  ///
  /// The comments give the printed cases without the sign. Each piece is a function of x = q - (start of the piece).
  /// U_over_H is a parameter because H may be 0.
  constexpr std::array<Quadratic<Scalar>, 5> edge(Scalar A, Scalar U, Scalar U_over_H, int sign) const noexcept {
    using namespace lane;
    using Piece = Quadratic<Scalar>;
    const auto& [X, A_I, A_O, Q, F] = constants_;
    const auto thin = U <= X;    // the tip is longer than the path through the membrane
    const Scalar m = min(U, X);  // the largest length of membrane on the tip
    const Scalar m_over_H = select(thin, U_over_H, X / H_);
    const Scalar shaft_over_H =
        select(thin, Scalar(0), (U - X) / H_);  // length of membrane on the shaft at q = max(U, X), over H

    std::array<Piece, 5> phi{};
    // Case 1, q < 0: phi[0] is 0.
    // Case 3, q in [U, X]: A U (2q - U + 2Q) / 2H
    // Case 4, q in [X, U]: F (q - X) / H + A X (X + 2Q) / 2H
    phi[2] = {A * m_over_H * (m / 2 + Q), select(thin, A * U_over_H, F / H_), 0};
    // Case 6, q > X + U: F U / H
    phi[4] = {F * U_over_H, 0, 0};
    // With H = 0, cases 2 and 5 have intervals of length 0 and would divide by 0. The next case replaces them.
    const auto thick = U > 0;
    // Case 2, q in [0, min(U, X)]: A q (q + 2Q) / 2H
    phi[1] = select(thick, Piece{0, A * Q / H_, A / (2 * H_)}, phi[2]);
    // Case 5, q in [max(U, X), X + U]: F (q - X) / H + A (U + X - q)(q - U + X + 2Q) / 2H
    const Piece leaving{A * m_over_H * (X + Q - m / 2) + F * shaft_over_H, (A * (m - X - Q) + F) / H_, -A / (2 * H_)};
    phi[3] = select(thick, leaving, phi[4]);
    if (sign < 0)
      for (auto& piece : phi) piece = {0 - piece.c0, 0 - piece.c1, 0 - piece.c2};  // 0 - x, because -x could be -0
    return phi;
  }

  LawConstants<Scalar> constants_;
  Scalar H_, U_;
  Pieces pieces_;
};

template <typename Scalar>
inline constexpr bool is_proven<BasicThickLaw<Scalar>> = true;
using ThickLaw = BasicThickLaw<double>;
using ThickLawF = BasicThickLaw<float>;

}  // namespace punctura
