// A law given by a profile: the average of the profile over the path through the wall.
#pragma once

#include <cstddef>
#include <span>

#include "punctura/model/average.hpp"
#include "punctura/model/law.hpp"

namespace punctura {

/// Phi(q) = 1/H * integral of the profile from q - U to q, N, with U = H / cos(beta), K06 (16). It is piecewise
/// quadratic, with breaks at every knot and at every knot + U, so both solvers are exact.
///
/// H = 0 gives the profile / cos(beta). The profile must have passed check_profile().
template <typename Scalar_, std::size_t Most = max_knots>
class BasicProfileLaw {
 public:
  using Scalar = Scalar_;
  using Pieces = ManyPieces<Scalar, 2 * Most + 1>;

  /// thickness: H, m. cos_beta: n.b, for pieces() and band().
  constexpr BasicProfileLaw(const BasicProfile<Scalar, Most>& profile, Scalar thickness,
                            Scalar cos_beta = Scalar(1)) noexcept
      : profile_(profile), H_(thickness), pieces_(pieces(cos_beta)) {}

  /// The pieces for a needle that enters with n.b = cos_beta > 0.
  constexpr Pieces pieces(Scalar cos_beta) const noexcept {
    Pieces all;
    detail::average(profile_, H_, cos_beta, all);
    return all;
  }
  constexpr const Pieces& pieces() const noexcept { return pieces_; }
  constexpr Band<Scalar> band(Scalar q) const noexcept {
    return pieces_.band(q);
  }  ///< at depth q (m, along the needle), N
  constexpr const BasicProfile<Scalar, Most>& profile() const noexcept { return profile_; }
  constexpr Scalar thickness() const noexcept { return H_; }  ///< H, m

 private:
  BasicProfile<Scalar, Most> profile_;
  Scalar H_;
  Pieces pieces_;
};
using ProfileLaw = BasicProfileLaw<double>;
static_assert(ObliqueLaw<ProfileLaw>);

/// Writes the weights w_i of the knots at depth q (m): Phi(q) = sum of phi(knot i) w_i. K06 (16) with a hat function
/// per knot.
///
/// depths: of the knots, m, as in a profile. H: thickness, m. weights: one for each knot. While the needle slides in at
/// known depths, the force is so linear in the knots' values.
template <typename Scalar>
constexpr void profile_weights(std::span<const Scalar> depths, const Scalar& H, const Scalar& cos_beta, const Scalar& q,
                               std::span<Scalar> weights) noexcept {
  using namespace lane;
  const std::size_t n = depths.size();
  for (Scalar& w : weights) w = Scalar(0);
  if (H == 0) {  // the hats themselves
    if (!(q >= depths[0])) return;
    std::size_t i = 1;
    while (i < n && q > depths[i]) ++i;
    const Scalar t = i < n ? (q - depths[i - 1]) / (depths[i] - depths[i - 1]) : Scalar(0);
    weights[i - 1] = (1 - t) / cos_beta;
    if (i < n) weights[i] = t / cos_beta;
    return;
  }
  const Scalar from = q - H / cos_beta;
  for (std::size_t i = 0; i < n; ++i) {  // the part of the path on the line behind knot i
    const Scalar a = max(from, depths[i]), b = i + 1 < n ? min(q, depths[i + 1]) : q;
    if (!(a < b)) continue;
    const Scalar t = i + 1 < n ? ((a - depths[i]) + (b - depths[i])) / (2 * (depths[i + 1] - depths[i])) : Scalar(0);
    weights[i] += (1 - t) * (b - a) / H;
    if (i + 1 < n) weights[i + 1] += t * (b - a) / H;
  }
}

}  // namespace punctura
