// Many simulated operators that a program steers at once, in lanes and on threads.
#pragma once

#include <memory>
#include <vector>

#include "punctura_runtime/batch/fleet_block.hpp"

namespace punctura::batch {

/// Trials that each have a scene, a place and a seed of their own. The results of a trial do not depend on the other
/// trials, on the threads or on the instruction set, and have the bits of an Experiment with a Steered motion.
class Fleet {
 public:
  /// threads: 0 is one for each processor.
  explicit Fleet(const FleetSetup& setup, std::size_t threads = 0);
  Fleet(const Fleet&) = delete;

  std::size_t size() const noexcept { return size_; }
  std::size_t threads() const noexcept { return threads_; }
  const LineCode& code() const noexcept { return *setup_.code; }

  /// Starts trial i anew, or adds one (i = size()). The scene must have passed check().
  /// start: place of the tip, m. seed: of tremor and encoders.
  void place(std::size_t i, const Scene& scene, const Vector3d& start, std::uint64_t seed);
  /// Starts the record of a step. Call it before step().
  void begin();
  /// Makes `ticks` ticks, at least one. speed: of the hand along the needle, m/s, one for each trial, finite. If memory
  /// runs out, it throws std::bad_alloc, and some trials have made the ticks. place() all trials again then.
  void step(const double* speed, std::size_t ticks);
  /// What happened to trial i since begin(). ticks: since then.
  TrialRecord record(std::size_t i, std::size_t ticks) const;
  /// What a copy of trial i needs.
  const TrialHistory& history(std::size_t i) const noexcept;
  /// Replaces all trials by those with these histories: all make their ticks again, together, so that they come into
  /// lanes. The scenes must have passed check().
  void restore(const std::vector<TrialHistory>& trials);
  /// Whether lanes compute the trial; otherwise it is computed alone.
  bool in_lanes(std::size_t i) const noexcept;

 private:
  FleetSetup setup_;
  std::size_t threads_, width_, size_ = 0;  ///< width_: trials of a block
  std::vector<std::unique_ptr<FleetBlock>> blocks_;
};

}  // namespace punctura::batch
