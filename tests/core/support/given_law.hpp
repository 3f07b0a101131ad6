// A law with given pieces.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "punctura/model/law.hpp"

namespace punctura::test {

template <std::size_t n>
struct GivenLaw {
  using Scalar = double;
  PiecewiseBand<double, n> table;
  const PiecewiseBand<double, n>& pieces() const noexcept { return table; }
  PiecewiseBand<double, n> pieces(double) const noexcept { return table; }
};

/// The same band with m pieces. The added breaks are at infinity, and the added pieces are copies of the last one.
template <std::size_t m, std::size_t n>
PiecewiseBand<double, m> with_room(const PiecewiseBand<double, n>& band) noexcept {
  PiecewiseBand<double, m> more;
  more.breaks.fill(std::numeric_limits<double>::infinity());
  more.pieces.fill(band.pieces[n - 1]);
  std::copy(band.breaks.begin(), band.breaks.end(), more.breaks.begin());
  std::copy(band.pieces.begin(), band.pieces.end(), more.pieces.begin());
  return more;
}

}  // namespace punctura::test
