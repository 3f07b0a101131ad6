// The band of friction forces at one depth.
#pragma once

#include "punctura/model/finite_math.hpp"
#include "punctura/model/lane.hpp"

namespace punctura {

/// The band of friction forces at one depth: [Phi_I, Phi_O], N. K06 (12), (16).
///
/// The needle can rest at any force in the band. A positive force pushes the needle out.
template <typename Scalar>
struct Band {
  Scalar lower;  ///< Phi_I, N: kinetic friction while the needle moves in
  Scalar upper;  ///< Phi_O, N: kinetic friction while the needle moves out

  /// Clamps f (N) to the band, K06 (32).
  constexpr Scalar clamp(Scalar f) const noexcept {
    using namespace lane;
    return min(max(f, lower), upper);
  }
};

template <typename M, Lanes V>
constexpr Band<V> select(const M& mask, const Band<V>& a, const Band<V>& b) noexcept {
  return {select(mask, a.lower, b.lower), select(mask, a.upper, b.upper)};
}

}  // namespace punctura
