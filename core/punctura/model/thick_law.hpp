// K06 section 2.2: a membrane of thickness H, crossed at an angle beta to its normal.
#pragma once

#include <algorithm>

#include "punctura/model/thin_law.hpp"

namespace punctura {

/// Phi(q) = 1/H * integral of phi from q - U to q, with U = H / cos(beta). K06 (16) to (19).
///
/// At depth q the needle runs through a length U of membrane: a part of it lies on the tip, where phi grows linearly
/// (so its integral is length times phi at the middle), the rest on the shaft, where phi is F. The lengths change their
/// rule at 0, min(U,X), max(U,X) and X + U, which gives the five pieces of (18) and (19) that hold a force.
///
/// H = 0 is the limit: the thin law times 1 / cos(beta). Parameters must have passed check() (model/validity.hpp).
template <typename Scalar_>
class BasicThickLaw {
 public:
  using Scalar = Scalar_;

  BasicThickLaw(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane, Scalar obliquity = 0) noexcept
      : constants_(needle, membrane), H_(membrane.thickness) {
    set_obliquity(std::cos(obliquity));
  }

  /// Lays the law out for a needle that enters with n.b = cos_beta > 0.
  void set_obliquity(Scalar cos_beta) noexcept {
    U_ = H_ / cos_beta;  // K06 (17)
    const Scalar X = constants_.X;
    pieces_.breaks = {0, std::min(U_, X), std::max(U_, X), X + U_};
    for (std::size_t i = 1; i < 5; ++i) pieces_.pieces[i].origin = pieces_.breaks[i - 1];

    const auto in = edge(constants_.A_I, 1 / cos_beta), out = edge(constants_.A_O, 1 / cos_beta, true);
    for (std::size_t i = 1; i < 5; ++i) {
      pieces_.pieces[i].lower = in[i];
      pieces_.pieces[i].upper = out[i];
    }
  }

  /// The band at depth q (m, along the needle), N.
  Band<Scalar> band(Scalar q) const noexcept { return pieces_.band(q); }

  const PiecewiseBand<Scalar, 5>& pieces() const noexcept { return pieces_; }
  const LawConstants<Scalar>& constants() const noexcept { return constants_; }
  Scalar thickness() const noexcept { return H_; }    ///< H, m
  Scalar path_length() const noexcept { return U_; }  ///< U, m

 private:
  /// The pieces of Phi_I (A = A_I) or, withdrawing, of Phi_O (A = A_O). U_over_H is handed in since H may be 0.
  std::array<Quadratic<Scalar>, 5> edge(Scalar A, Scalar U_over_H, bool withdrawing = false) const noexcept {
    const auto& [X, A_I, A_O, Q, F] = constants_;
    const bool thin = U_ <= X;         // all of the membrane fits on the tip
    const Scalar m = std::min(U_, X);  // most membrane that ever lies on the tip
    const Scalar m_over_H = thin ? U_over_H : X / H_;
    const Scalar shaft_over_H = thin ? 0 : (U_ - X) / H_;  // membrane on the shaft when the tip begins to leave

    std::array<Quadratic<Scalar>, 5> phi{};
    phi[2] = {A * m_over_H * (m / 2 + Q), thin ? A * U_over_H : F / H_, 0};
    phi[4] = {F * U_over_H, 0, 0};
    if (U_ > 0) {
      phi[1] = {0, A * Q / H_, A / (2 * H_)};
      phi[3] = {A * m_over_H * (X + Q - m / 2) + F * shaft_over_H, (A * (m - X - Q) + F) / H_, -A / (2 * H_)};
    } else {
      phi[1] = phi[2];  // H = 0: the surface is met at once, the far face left at once
      phi[3] = phi[4];
    }
    if (!withdrawing)
      for (auto& piece : phi) piece = {0 - piece.c0, 0 - piece.c1, 0 - piece.c2};  // 0 - x: no negative zero
    return phi;
  }

  LawConstants<Scalar> constants_;
  Scalar H_, U_{};
  PiecewiseBand<Scalar, 5> pieces_{};
};

using ThickLaw = BasicThickLaw<double>;
using ThickLawF = BasicThickLaw<float>;

}  // namespace punctura
