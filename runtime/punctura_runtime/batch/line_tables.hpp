// The bands of the trials, of laws with any number of pieces.
#pragma once

#include <cmath>
#include <limits>

#include "punctura/proxy/exact_friction.hpp"
#include "punctura_runtime/batch/line_block.hpp"

namespace punctura::batch {

/// The BandTable of a band. The table points to the band.
template <typename Pieces>
BandTable table_of(const Pieces& band) noexcept {
  const auto load = [](const void* pieces, LineBlock& block, std::size_t lane, double q) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Pieces& all = *static_cast<const Pieces*>(pieces);
    const auto store = [lane](LaneNumbers(&to)[3], const Quadratic<double>& edge) {
      to[0].of[lane] = edge.c0;
      to[1].of[lane] = edge.c1;
      to[2].of[lane] = edge.c2;
    };
    const auto store_piece = [&](const BandPiece<double>& piece) {
      block.origin.of[lane] = piece.origin;
      store(block.lower, piece.lower);
      store(block.upper, piece.upper);
    };
    if constexpr (requires { all.around(q); }) {  // a wall that remembers a hole
      const auto around = all.around(q);
      block.first.of[lane] = around.first;
      block.last.of[lane] = around.last;
      return store_piece(around.piece);
    }
    const std::size_t i = all.index(q);
    // A closed interval of doubles: the first break belongs to the piece behind it, the others to the piece in front.
    block.first.of[lane] = i == 0 ? -infinity : i == 1 ? all.breaks[0] : std::nextafter(all.breaks[i - 1], infinity);
    block.last.of[lane] = i == 0            ? std::nextafter(all.breaks[0], -infinity)
                          : i == all.last() ? infinity
                                            : all.breaks[i];
    store_piece(all.piece(i));
  };
  const auto exact_force = [](const void* pieces, double q_prev, double f_star, double g) noexcept {
    return exact_friction(*static_cast<const Pieces*>(pieces), q_prev, f_star, g).force;
  };
  return {&band, load, exact_force};
}

}  // namespace punctura::batch
