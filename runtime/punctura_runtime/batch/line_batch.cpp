#include "punctura_runtime/batch/line_batch.hpp"

#include <algorithm>
#include <mutex>

#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/batch/line_tile.hpp"

namespace punctura::batch {
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
