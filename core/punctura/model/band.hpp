// What a law says at one depth: the forces at which the needle may rest.
#pragma once

#include <algorithm>

#include "punctura/model/finite_math.hpp"

namespace punctura {

/// [Phi_I, Phi_O] at one depth, N. Positive forces push the needle out. K06 (12), (16).
template <typename Scalar>
struct Band {
  Scalar lower;  ///< Phi_I: kinetic friction while the needle goes in
  Scalar upper;  ///< Phi_O: kinetic friction while it comes out

  /// The force of the band nearest to f, the clamp of K06 (32).
  constexpr Scalar clamp(Scalar f) const noexcept { return std::min(std::max(f, lower), upper); }
};

}  // namespace punctura
