// What a law says at one depth: the forces at which the needle may rest.
#pragma once

#include "punctura/model/finite_math.hpp"
#include "punctura/model/lane.hpp"

namespace punctura {

/// [Phi_I, Phi_O] at one depth, N. Positive forces push the needle out. K06 (12), (16).
template <typename Scalar>
struct Band {
  Scalar lower;  ///< Phi_I: kinetic friction while the needle goes in
  Scalar upper;  ///< Phi_O: kinetic friction while it comes out

  /// The force of the band nearest to f, the clamp of K06 (32).
  constexpr Scalar clamp(Scalar f) const noexcept {
    using namespace lane;
    return min(max(f, lower), upper);
  }
};

template <typename M, Lanes V>
Band<V> select(const M& mask, const Band<V>& a, const Band<V>& b) noexcept {
  return {select(mask, a.lower, b.lower), select(mask, a.upper, b.upper)};
}

}  // namespace punctura
