#include "punctura_runtime/batch/line_batch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/batch/line_block.hpp"

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

void load_pieces(LineBlock& block, std::size_t start, unsigned lanes, const double* q) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    const BandTable& table = block.table[start + i];
    table.load(table.pieces, block, start + i, q[i]);
  }
}

void exact_forces(const LineBlock& block, std::size_t start, unsigned lanes, const double* q_prev, const double* f_star,
                  double* force) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    const BandTable& table = block.table[start + i];
    force[i] = table.exact_force(table.pieces, q_prev[i], f_star[i], block.g.of[start + i]);
  }
}

namespace {

/// Empty: each lane loads its piece in the next tick.
void clear_pieces(LineBlock& block) noexcept {
  std::fill(std::begin(block.first.of), std::end(block.first.of), 1.0);
  std::fill(std::begin(block.last.of), std::end(block.last.of), 0.0);
}

/// The state of a block, to go back to.
struct SavedState {
  LaneNumbers p, e, f;
  bool started;

  explicit SavedState(const LineBlock& block) : p(block.p), e(block.e), f(block.f), started(block.started) {}
  void restore(LineBlock& block) const noexcept {
    block.p = p;
    block.e = e;
    block.f = f;
    block.started = started;
    clear_pieces(block);
  }
};

}  // namespace

void LineBatch::add(const BandTable& table, const SampledCoupling<double>& coupling) {
  const std::size_t lane = trials_ % block_lanes;
  if (lane == 0) clear_pieces(blocks_.emplace_back());
  LineBlock& block = blocks_.back();
  // The lanes behind the last trial repeat it, because all lanes are always computed.
  for (std::size_t i = lane; i < block_lanes; ++i) {
    block.K.of[i] = coupling.K;
    block.g.of[i] = coupling.g;
    block.inv_g.of[i] = coupling.inv_g;
    block.B_over_D.of[i] = coupling.B_over_D;
    block.table[i] = table;
  }
  ++trials_;
}

void LineBatch::reset() noexcept {
  for (LineBlock& block : blocks_) {
    block.p = block.e = block.f = {};
    block.started = false;
    clear_pieces(block);
  }
}

void LineBatch::complete_blocks() noexcept {
  for (LineBlock& block : blocks_) clear_pieces(block);
  if (trials_ == 0) return;
  const std::size_t last = (trials_ - 1) % block_lanes;
  for (LaneNumbers* numbers : {&blocks_.back().p, &blocks_.back().e, &blocks_.back().f})
    std::fill(numbers->of + last, numbers->of + block_lanes, numbers->of[last]);
}

LineBatch::Outcome LineBatch::run(std::size_t ticks, const Grid<const double>& p, const Grid<double>& force,
                                  const RunOptions& options) {
  Outcome outcome;
  if (ticks == 0 || trials_ == 0) return outcome;
  const RunLine code = (options.code ? *options.code : *line_codes().front()).of(solver_);
  const std::size_t together = std::max<std::size_t>(1, (options.block + block_lanes - 1) / block_lanes);
  const std::vector<SavedState> before(blocks_.begin(), blocks_.end());
  std::mutex lock;
  Work work;

  const auto run_blocks = [&](std::size_t index) {
    const std::size_t from = index * together, to = std::min(blocks_.size(), from + together);
    LineTile tile;
    for (std::size_t tick = 0; tick < ticks && !work.stop; tick += tile_ticks) {
      const std::size_t n = std::min(tile_ticks, ticks - tick);
      for (std::size_t b = from; b < to; ++b) {
        const std::size_t trial = b * block_lanes;
        const TilePlace place{tick, trial, n, std::min(block_lanes, trials_ - trial)};
        if (tile.run(code, blocks_[b], place, p, force)) continue;
        const BadDepth bad = tile.bad_depth(place, p);
        const std::lock_guard guard(lock);
        work.stop = true;
        if (!outcome.bad || std::pair(bad.trial, bad.tick) < std::pair(outcome.bad->trial, outcome.bad->tick))
          outcome.bad = bad;
        return;
      }
      work.done += n * (to - from);
    }
  };
  std::function<bool()> watch;
  if (options.watch)
    watch = [&] {
      outcome.stopped = !options.watch(work.done, ticks * blocks_.size());
      return !outcome.stopped;
    };
  const auto restore = [&] {
    for (std::size_t b = 0; b < blocks_.size(); ++b) before[b].restore(blocks_[b]);
  };
  try {
    for_each_block((blocks_.size() + together - 1) / together, usable_threads(options.threads), work, run_blocks,
                   watch);
  } catch (...) {
    restore();
    throw;
  }
  if (!outcome.finished()) restore();
  return outcome;
}

}  // namespace punctura::batch
