// Trials of a fleet in the lanes of a block, whatever the instruction set.
#pragma once

#include <memory>

#include "punctura_runtime/batch/scene_block.hpp"

namespace punctura::batch {

/// What happened in a step of each lane, as in TrialRecord.
struct FleetRecord {
  LaneNumbers force, lowest_force, highest_force, travel;
  std::vector<LaneNumbers> depth, deepest;  ///< of each membrane
  std::uint64_t invalid = 0;                ///< bits of the lanes whose results are void
};

/// The state of the trials of a block between two steps.
///
/// Constructor and destructor are compiled once, for any processor: the files of the instruction sets must not have
/// copies of code that others can use (tools/check_isa.sh).
class FleetLanes {
 public:
  explicit FleetLanes(std::size_t membranes);
  virtual ~FleetLanes();
  /// Starts lanes [from, to) anew, with the numbers that are in the block now.
  virtual void restart(std::size_t from, std::size_t to) noexcept = 0;
  /// Starts the record of a step.
  virtual void begin() noexcept = 0;
  /// The ticks whose inputs are in the block.
  virtual void step(std::size_t ticks) noexcept = 0;
  const FleetRecord& record() const noexcept { return record_; }

 protected:
  FleetRecord record_;
};

/// Makes the lanes of a block. The block must outlive them.
using MakeFleet = std::unique_ptr<FleetLanes> (*)(SceneBlock& block);

}  // namespace punctura::batch
