// The door for friction laws: K06's two, and those of other authors.
#pragma once

#include <concepts>

#include "punctura/model/band.hpp"

namespace punctura {

/// A law gives its band at a depth, and the quadratic pieces of which that band is made (PiecewiseBand).
/// Lower edge <= upper edge everywhere, both 0 before the first break, both constant behind the last.
template <typename L>
concept Law = requires(const L law, typename L::Scalar depth) {
  typename L::Scalar;
  { law.band(depth) } noexcept -> std::same_as<Band<typename L::Scalar>>;
  { law.pieces().band(depth) } noexcept -> std::same_as<Band<typename L::Scalar>>;
};

/// A law that can be laid out anew for the obliquity at which the needle enters, K06 (17).
template <typename L>
concept ObliqueLaw = Law<L> && requires(L law, typename L::Scalar cos_beta) {
  { law.set_obliquity(cos_beta) } noexcept;
};

}  // namespace punctura
