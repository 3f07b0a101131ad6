// A law with given pieces.
#pragma once

#include <cstddef>

#include "punctura/model/law.hpp"

namespace punctura::test {

template <std::size_t n>
struct GivenLaw {
  using Scalar = double;
  PiecewiseBand<double, n> table;
  const PiecewiseBand<double, n>& pieces() const noexcept { return table; }
  PiecewiseBand<double, n> pieces(double) const noexcept { return table; }
};

}  // namespace punctura::test
