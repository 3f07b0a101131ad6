// The depths at which a needle's way through a membrane turns, from the pieces of the membrane's law.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "punctura/model/law.hpp"
#include "punctura/model/needle.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/proxy/in_space.hpp"

namespace punctura {

/// Depths along the needle, m, for a needle with n.b = cos_beta.
struct Crossing {
  double cos_beta;
  double far_face;  ///< the tip's point comes out behind: U, K06 (17)
  double peak;      ///< the resistance -Phi_I is largest
  double through;   ///< the slanted face is out behind, too, and only the shaft rubs: X + U, K06 (18). See crossing()
  double again;     ///< a tip that has come back to here can pop again
  double shaft;     ///< resistance of the shaft alone, N: F U / H, K06 (18)
};

/// Share of the tip's length that the tip must come back before the peak, for another pop to count.
inline constexpr double pop_again = 0.1;

namespace detail {
/// The last break, behind which the law is constant. Breaks at infinity (a law with room for more pieces has them) do not count.
template <typename Scalar, std::size_t N>
std::size_t last_break(const PiecewiseBand<Scalar, N>& law) noexcept {
  std::size_t last = N - 2;
  while (last > 0 && !std::isfinite(law.breaks[last])) --last;
  return last;
}

template <typename Scalar>
struct Peak {
  Scalar depth, resistance;  // m, N
};

/// The largest resistance up to the last break; the first such depth if there are several.
template <typename Scalar, std::size_t N>
Peak<Scalar> peak_of(const PiecewiseBand<Scalar, N>& law) noexcept {
  Peak<Scalar> peak{law.breaks[0], 0};
  for (std::size_t k = 1; k <= last_break(law); ++k) {
    const Scalar from = law.breaks[k - 1], to = law.breaks[k], origin = law.pieces[k].origin;
    const auto& [c0, c1, c2] = law.pieces[k].lower;
    // A piece is largest at an end, or where its slope c1 + 2 c2 x is 0. Of K06's pieces only q > max(U, X) can have such a place.
    const Scalar turn = c2 > 0 ? std::clamp(origin - c1 / (2 * c2), from, to) : from;
    for (const Scalar at : {from, turn, to})
      if (const Scalar resistance = -law.pieces[k].lower.value(at - origin); resistance > peak.resistance)
        peak = {at, resistance};
  }
  return peak;
}
}  // namespace detail

/// The crossing of any law. `through` is the law's last break; if its resistance does not fall before that, it has no pop, and
/// `through` is infinite. A law with memory gives the pieces of an untouched membrane.
///
/// thickness: H, m. A cos_beta outside [cos(80 degrees), 1] counts as the nearer end, NaN counts as 1.
template <ObliqueLaw L>
Crossing crossing(const L& law, const Needle& needle, double thickness, double cos_beta) noexcept {
  cos_beta = std::isfinite(cos_beta) ? std::clamp(cos_beta, grazing_cosine<double>, 1.0) : 1.0;
  const auto pieces = law.pieces(static_cast<typename L::Scalar>(cos_beta));
  const std::size_t last = detail::last_break(pieces);
  const auto peak = detail::peak_of(pieces);
  const auto shaft = -pieces.pieces[last + 1].lower.c0;
  const auto depth = static_cast<double>(peak.depth);
  return {cos_beta,
          thickness / cos_beta,  // K06 (17)
          depth,
          peak.resistance > shaft ? static_cast<double>(pieces.breaks[last]) : no_bound,
          depth - pop_again * tip_length(needle),
          static_cast<double>(shaft)};
}

/// n.b of a needle that is inside. b: the direction held since entry. Where b is no direction, the stylus's axis counts; where that is
/// none either, the result is 1.
inline double entry_cosine(const Vector3d& normal, const Vector3d& b, const Vector3d& axis) noexcept {
  for (const Vector3d& direction : {b, axis})
    if (const double length = direction.norm(); std::isfinite(length) && length > 0)
      return normal.dot(direction) / length;
  return 1;
}

}  // namespace punctura
