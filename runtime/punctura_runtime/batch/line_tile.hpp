// Some ticks of a block: brings depths and results into the order that run_line() needs, if they are in another one.
#pragma once

#include <algorithm>
#include <cmath>

#include "punctura_runtime/batch/line_batch.hpp"

namespace punctura::batch {

/// Few enough that depths and forces of a tile stay in the first cache.
inline constexpr std::size_t tile_ticks = 64;

/// The ticks and the trials of a tile.
struct TilePlace {
  std::size_t tick, trial, ticks, trials;
};

class LineTile {
 public:
  /// Returns false if a depth is no place.
  bool run(RunLine code, LineBlock& block, const TilePlace& at, const Grid<const double>& p,
           const Grid<double>& force) noexcept {
    const bool full = at.trials == block_lanes;
    LineSpan span{at.ticks, p.at(at.tick, at.trial), p.by_tick, p.by_trial == 0, nullptr, 0};
    if (!span.shared && !(full && p.by_trial == 1)) {
      gather(at, p);
      span.p = depth_;
      span.p_stride = block_lanes;
    }
    const bool direct = full && force.by_trial == 1;
    if (force.data) {
      span.force = direct ? force.at(at.tick, at.trial) : force_;
      span.force_stride = direct ? force.by_tick : static_cast<std::ptrdiff_t>(block_lanes);
    }
    const bool good = code(block, span);
    if (force.data && !direct) scatter(at, force);
    return good;
  }

  /// The first depth of a tile that is no place, by trial and then by tick.
  static BadDepth bad_depth(const TilePlace& at, const Grid<const double>& p) noexcept {
    for (std::size_t i = at.trial; i < at.trial + at.trials; ++i)
      for (std::size_t k = at.tick; k < at.tick + at.ticks; ++k)
        if (!is_place(*p.at(k, i))) return {k, i};
    return {at.tick, at.trial};
  }

 private:
  void gather(const TilePlace& at, const Grid<const double>& p) noexcept {
    for (std::size_t i = 0; i < at.trials; ++i) {
      const double* from = p.at(at.tick, at.trial + i);
      for (std::size_t k = 0; k < at.ticks; ++k)
        depth_[k * block_lanes + i] = from[static_cast<std::ptrdiff_t>(k) * p.by_tick];
    }
    for (std::size_t k = 0; k < at.ticks; ++k)  // the lanes without a trial repeat the last one
      std::fill(depth_ + k * block_lanes + at.trials, depth_ + (k + 1) * block_lanes,
                depth_[k * block_lanes + at.trials - 1]);
  }
  void scatter(const TilePlace& at, const Grid<double>& to) const noexcept {
    for (std::size_t i = 0; i < at.trials; ++i) {
      double* column = to.at(at.tick, at.trial + i);
      for (std::size_t k = 0; k < at.ticks; ++k)
        column[static_cast<std::ptrdiff_t>(k) * to.by_tick] = force_[k * block_lanes + i];
    }
  }

  alignas(64) double depth_[tile_ticks * block_lanes];
  alignas(64) double force_[tile_ticks * block_lanes];
};

}  // namespace punctura::batch
