// Independent proxies on a line that are computed together: their constants, states and present pieces.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "punctura/model/piecewise_band.hpp"
#include "punctura/proxy/exact_friction.hpp"

namespace punctura::batch {

/// The trials of a block. A multiple of the lanes of all instruction sets.
inline constexpr std::size_t block_lanes = 32;

struct LineBlock;

/// The band of one trial, of any law without memory, for the few ticks in which a lane needs more than its piece.
struct BandTable {
  const void* pieces;  ///< a PiecewiseBand<double, n>
  /// Stores the piece that contains depth q (m) as the present piece of a lane.
  void (*load)(const void* pieces, LineBlock& block, std::size_t lane, double q) noexcept;
  /// The friction force of exact_friction(), N.
  double (*exact_force)(const void* pieces, double q_prev, double f_star, double g) noexcept;
};

/// Numbers of a block, one for each lane.
struct LaneNumbers {
  alignas(64) double of[block_lanes];
};

/// A block. Units and symbols are those of LineParams and LineState.
struct LineBlock {
  LaneNumbers K, g, inv_g, B_over_D;  ///< coupling
  LaneNumbers p, e, f;                ///< state
  bool started = false;

  /// The piece of the band in which each lane is, for depths in [first, last]. It is empty at the start: first > last.
  LaneNumbers first, last, origin;
  LaneNumbers lower[3];  ///< coefficients of Phi_I, see Quadratic
  LaneNumbers upper[3];  ///< coefficients of Phi_O
  BandTable table[block_lanes];
};

/// What run_line() shall compute. Element (tick, lane) of an array is at [tick * stride + lane].
struct LineSpan {
  std::size_t ticks;
  const double* p;          ///< depths of the device, m
  std::ptrdiff_t p_stride;  ///< doubles from tick to tick
  bool shared;              ///< all lanes have the depth of the first lane
  double* force;            ///< f, N; null if not wanted
  std::ptrdiff_t force_stride;
};

/// Makes the ticks of a block. Returns false, and leaves no usable state, if a depth is not a place.
using RunLine = bool (*)(LineBlock& block, const LineSpan& span) noexcept;

/// For the lanes in `lanes` (bits): makes the piece at depth q the present piece. q: m, of `count` lanes from `start`.
void load_pieces(LineBlock& block, std::size_t start, unsigned lanes, const double* q) noexcept;
/// For the lanes in `lanes` (bits): the friction force of exact_friction(), N.
void exact_forces(const LineBlock& block, std::size_t start, unsigned lanes, const double* q_prev, const double* f_star,
                  double* force) noexcept;

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
