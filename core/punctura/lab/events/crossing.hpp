// The characteristic depths of a needle that crosses a membrane, from the pieces of the law.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "punctura/model/law.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/mixed_law.hpp"

namespace punctura {

/// The characteristic depths along the needle, m, for a needle with n.b = cos_beta. Scalar: a number, or lanes.
template <typename Scalar>
struct BasicCrossing {
  Scalar cos_beta;
  Scalar far_face;  ///< the tip's point passes the far face: U, K06 (17)
  Scalar peak;      ///< the insertion friction -Phi_I has its maximum
  Scalar through;   ///< the slanted face passes the far face, X + U, K06 (18); see crossing()
  Scalar again;     ///< a tip that comes back to this depth can pop again
  Scalar shaft;     ///< friction of the shaft alone, N: F U / H, K06 (18)
  Scalar settled;   ///< the friction is constant from here on. In K06's law: `through`
};
using Crossing = BasicCrossing<double>;

template <typename M, Lanes V>
BasicCrossing<V> select(const M& mask, const BasicCrossing<V>& a, const BasicCrossing<V>& b) noexcept {
  return {select(mask, a.cos_beta, b.cos_beta), select(mask, a.far_face, b.far_face), select(mask, a.peak, b.peak),
          select(mask, a.through, b.through),   select(mask, a.again, b.again),       select(mask, a.shaft, b.shaft),
          select(mask, a.settled, b.settled)};
}

/// After a pop, the tip must come back to this part of its length in front of the peak before it can pop again.
inline constexpr double pop_again = 0.1;

namespace detail {
/// The index of the last break. Behind it, the law is constant. Breaks at infinity are not in use.
template <typename Pieces>
std::size_t last_break(const Pieces& law) noexcept {
  std::size_t last = law.breaks.size() - 1;
  while (last > 0 && !std::isfinite(law.breaks[last])) --last;
  return last;
}

template <typename Scalar>
struct Peak {
  Scalar depth, resistance;  // m, N
};

/// The maximum of the insertion friction up to the last break. If several depths have it, the first one.
template <typename Pieces, typename Scalar = typename Pieces::Scalar>
Peak<Scalar> peak_of(const Pieces& law) noexcept {
  Peak<Scalar> peak{law.breaks[0], 0};
  for (std::size_t k = 1; k <= last_break(law); ++k) {
    const Scalar from = law.breaks[k - 1], to = law.breaks[k], origin = law.pieces[k].origin;
    const auto& [c0, c1, c2] = law.pieces[k].lower;
    // A piece has its maximum at an end, or where its slope c1 + 2 c2 x is 0. In K06's law, only the piece behind
    // max(U, X) can have such a depth.
    const Scalar turn = c2 > 0 ? std::clamp(origin - c1 / (2 * c2), from, to) : from;
    for (const Scalar at : {from, turn, to})
      if (const Scalar resistance = -law.pieces[k].lower.value(at - origin); resistance > peak.resistance)
        peak = {at, resistance};
  }
  return peak;
}

/// The depth at which the slanted face has passed the far face. It is X + U if the law states its tip length X and has
/// its maximum no deeper than that; otherwise it is the last break of the law. pieces: of the law. U: m.
template <typename L, typename Pieces>
double passed(const L& law, const Pieces& pieces, double U) noexcept {
  const auto last = static_cast<double>(pieces.breaks[last_break(pieces)]);
  if constexpr (requires { law.tip_length(); })
    if (const double X_U = static_cast<double>(law.tip_length()) + U; X_U >= static_cast<double>(peak_of(pieces).depth))
      return std::min(X_U, last);
  return last;
}
}  // namespace detail

/// The crossing of a membrane with any law. thickness: H, m. For a law with memory, the membrane is untouched.
///
/// If the friction does not decrease before the last break of the law, there is no pop and `through` is infinite. See
/// detail::passed(). cos_beta is clamped to [cos(80 degrees), 1]. NaN counts as 1.
template <ObliqueLaw L>
Crossing crossing(const L& law, const Needle& needle, double thickness, double cos_beta) noexcept {
  cos_beta = std::isfinite(cos_beta) ? std::clamp(cos_beta, grazing_cosine<double>, 1.0) : 1.0;
  const auto pieces = untouched_pieces(law, static_cast<typename L::Scalar>(cos_beta));
  const std::size_t last = detail::last_break(pieces);
  const auto peak = detail::peak_of(pieces);
  const auto shaft = -pieces.pieces[last + 1].lower.c0;
  const auto depth = static_cast<double>(peak.depth);
  return {cos_beta,
          thickness / cos_beta,  // K06 (17)
          depth,
          peak.resistance > shaft ? detail::passed(law, pieces, thickness / cos_beta) : no_bound,
          depth - pop_again * tip_length(needle),
          static_cast<double>(shaft),
          static_cast<double>(pieces.breaks[last])};
}
/// The same for the law in use.
template <ObliqueLaw... Laws>
Crossing crossing(const MixedLaw<Laws...>& law, const Needle& needle, double thickness, double cos_beta) noexcept {
  Crossing of_one;
  law.visit([&]<std::size_t>(const auto& one) { of_one = crossing(one, needle, thickness, cos_beta); });
  return of_one;
}

/// n.b of a needle that is inside. b: the direction since entry. axis: the direction of the stylus, used if b is NaN
/// or zero. If axis is NaN or zero as well, the result is 1.
inline double entry_cosine(const Vector3d& normal, const Vector3d& b, const Vector3d& axis) noexcept {
  for (const Vector3d& direction : {b, axis})
    if (const double length = direction.norm(); std::isfinite(length) && length > 0)
      return normal.dot(direction) / length;
  return 1;
}

}  // namespace punctura
