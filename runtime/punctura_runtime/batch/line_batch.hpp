// Many independent trials of a proxy on a line, computed together.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "punctura/proxy/coupling.hpp"
#include "punctura_runtime/batch/line_tables.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/run_options.hpp"

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

  /// Adds a trial. The band must stay where it is as long as the batch exists: see keep().
  ///
  /// Pieces: a PiecewiseBand or ManyPieces.
  template <typename Pieces>
  void add(const Pieces& band, const Coupling& coupling) {
    add(table_of(band), SampledCoupling<double>(coupling, period_));
  }
  /// Owns something that a trial uses.
  void keep(std::shared_ptr<const void> owned) { kept_.push_back(std::move(owned)); }
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

 private:
  void add(const BandTable& table, const SampledCoupling<double>& coupling);

  double period_;
  Solver solver_;
  std::size_t trials_ = 0;
  std::vector<LineBlock> blocks_;
  std::vector<std::shared_ptr<const void>> kept_;
};

}  // namespace punctura::batch
