// Many independent trials of a proxy on a line, computed together.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <vector>

#include "punctura/model/vector3.hpp"
#include "punctura/proxy/coupling.hpp"
#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/batch/line_block.hpp"
#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::batch {

/// An array of one number for each tick and trial. Element (tick, trial) is at data[tick * by_tick + trial * by_trial].
template <typename Number>
struct Grid {
  Number* data = nullptr;
  std::ptrdiff_t by_tick = 0, by_trial = 0;

  Number* at(std::size_t tick, std::size_t trial) const noexcept {
    return data + static_cast<std::ptrdiff_t>(tick) * by_tick + static_cast<std::ptrdiff_t>(trial) * by_trial;
  }
};

/// A depth that is no place.
struct BadDepth {
  std::size_t tick, trial;
};

/// Independent proxies on a line (K06 section 3.1), each with its own law and coupling.
///
/// Each trial gets the bits that Proxy1d gives, whatever the instruction set, the blocks and the threads are.
class LineBatch {
 public:
  LineBatch(double period, Solver solver) noexcept : period_(period), solver_(solver) {}

  /// Adds a trial. The band must stay where it is as long as the batch and its copies exist.
  ///
  /// Pieces: a PiecewiseBand or ManyPieces.
  template <typename Pieces>
  void add(const Pieces& band, const Coupling& coupling) {
    add(table_of(band), SampledCoupling<double>(coupling, period_));
  }
  void reserve(std::size_t trials) { blocks_.reserve((trials + block_lanes - 1) / block_lanes); }

  std::size_t trials() const noexcept { return trials_; }
  Solver solver() const noexcept { return solver_; }
  double period() const noexcept { return period_; }  ///< T, s
  /// Memory of constants and states, bytes. The bands are not included.
  std::size_t bytes() const noexcept { return blocks_.capacity() * sizeof(LineBlock); }

  /// Resets all trials to the state before the first tick.
  void reset() noexcept;

  /// The result of run().
  struct Outcome {
    bool stopped = false;         ///< watch() returned false
    std::optional<BadDepth> bad;  ///< the first depth that is no place
    bool finished() const noexcept { return !stopped && !bad; }
  };

  /// Makes `ticks` ticks of all trials. p: depths, m. force: f, N; without data it is not stored.
  ///
  /// If it does not finish, all trials keep the state from before.
  Outcome run(std::size_t ticks, const Grid<const double>& p, const Grid<double>& force, const RunOptions& options);

  /// For save_state() and load_state().
  static void archive(auto& self, auto& state) {
    for (std::size_t trial = 0; trial < self.trials_; ++trial) {
      auto& block = self.blocks_[trial / block_lanes];
      const std::size_t lane = trial % block_lanes;
      if (lane == 0) state.flag(block.started);
      state.fields(block.p.of[lane], block.e.of[lane], block.f.of[lane]);
      state.require(is_place(block.p.of[lane]));
    }
    if constexpr (std::remove_reference_t<decltype(state)>::reading) self.complete_blocks();
  }
  /// The parameters but the bands, which are the caller's.
  void describe(auto& parameters) const {
    parameters.choice(solver_, Solver::exact);
    parameters.fields(period_);
    parameters.index(trials_, 0);
    for (std::size_t trial = 0; trial < trials_; ++trial) {
      const LineBlock& block = blocks_[trial / block_lanes];
      const std::size_t lane = trial % block_lanes;
      parameters.fields(block.K.of[lane], block.g.of[lane], block.inv_g.of[lane], block.B_over_D.of[lane]);
    }
  }

 private:
  void add(const BandTable& table, const SampledCoupling<double>& coupling);
  /// After the states were set: the lanes behind the last trial repeat it, and each lane loads its piece.
  void complete_blocks() noexcept;

  double period_;
  Solver solver_;
  std::size_t trials_ = 0;
  std::vector<LineBlock> blocks_;
};

}  // namespace punctura::batch
