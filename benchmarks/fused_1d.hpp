// The reference: K06 (33) written by hand as straight-line arithmetic.
#pragma once

#include <algorithm>

#include "punctura/model/membrane.hpp"
#include "punctura/proxy/coupling.hpp"

namespace bench {

/// The constants of the thick law with the divisions done in advance. K06 (15) to (19).
template <typename Scalar>
struct FusedLaw {
  Scalar X, U, two_Q, half_A_I, half_A_O, F;  ///< half_A_I, half_A_O and F are divided by H

  FusedLaw(const punctura::LawConstants<Scalar>& law, Scalar H, Scalar cos_beta)
      : X(law.X),
        U(H / cos_beta),
        two_Q(2 * law.Q),
        half_A_I(law.A_I / (2 * H)),
        half_A_O(law.A_O / (2 * H)),
        F(law.F / H) {}

  /// Clamps f* to [Phi_I(q), Phi_O(q)] without a branch. Each edge is G_A of the near face minus G_A of the far face;
  /// the two edges differ only in A. K06 (18), (19), (32).
  Scalar clamp(Scalar q, Scalar f_star) const noexcept {
    const Scalar far = q - U;
    const Scalar tip_near = std::min(q, X), tip_far = std::min(far, X);
    const Scalar z = std::max(tip_near, zero), z_far = std::max(tip_far, zero);
    const Scalar tip = z * (z + two_Q) - z_far * (z_far + two_Q);
    const Scalar shaft = F * ((q - tip_near) - (far - tip_far));
    const Scalar lower = -(half_A_I * tip + shaft), upper = half_A_O * tip + shaft;
    return std::min(std::max(f_star, lower), upper);
  }

 private:
  Scalar zero = 0;  ///< not a literal, because GCC 12 compiles a max with a literal 0 to a jump
};

template <typename Scalar>
class Fused1d {
 public:
  Fused1d(const FusedLaw<Scalar>& law, const punctura::BasicCoupling<Scalar>& coupling, Scalar T)
      : law_(law),
        K_(coupling.stiffness),
        g_(coupling.stiffness + coupling.damping / T),
        inv_g_(1 / g_),
        B_over_D_(coupling.damping / (coupling.stiffness * T + coupling.damping)) {}

  void start(Scalar p) noexcept {
    p_ = p;
    e_ = f_ = 0;
  }

  Scalar step(Scalar p) noexcept {
    const Scalar rest = B_over_D_ * e_;
    const Scalar f_star = K_ * e_ - g_ * (p - p_);    // K06 (27)
    f_ = law_.clamp(p + rest + inv_g_ * f_, f_star);  // K06 (31), (32)
    e_ = rest + inv_g_ * f_;                          // K06 (25)
    p_ = p;
    return f_;
  }

 private:
  FusedLaw<Scalar> law_;
  Scalar K_, g_, inv_g_, B_over_D_;
  Scalar p_{}, e_{}, f_{};
};

}  // namespace bench
