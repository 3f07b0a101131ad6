// Trials of a scene that are computed together: their constants, and the inputs of some ticks. The tip follows a
// simulated hand with a device, or given positions.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/noise.hpp"
#include "punctura/lab/plant/tip_motion.hpp"
#include "punctura/proxy/relaxing_coupling.hpp"
#include "punctura_runtime/batch/line_block.hpp"
#include "punctura_runtime/batch/run_summary.hpp"

namespace punctura::batch {

using LaneVectors = std::array<LaneNumbers, 3>;  ///< a Vector3 for each lane

class LaneTrials;

/// A membrane of each trial of a block.
struct MembraneBlock {
  LineBlock band{};               ///< the pieces for the direction in which each lane entered
  LaneVectors point{}, normal{};  ///< m; of length 1
  /// The fronts of a wall that remembers a hole, m (BasicHole); infinite for a wall that does not.
  LaneNumbers cut{}, made{};
  bool remembers = false;  ///< a wall of some lane does
};

/// The coupling of each trial, which is the same at all membranes: RelaxingCoupling::Constants.
struct CouplingBlock {
  LaneNumbers K, g, inv_g, free_share;
  std::array<LaneNumbers, max_branches> a, k;
  std::size_t branches;
};

/// The ticks whose inputs are ready at once.
inline constexpr std::size_t scene_ticks = 16;

/// What whole runs need from outside, and their results.
class RunOwner {
 public:
  /// Computes the inputs of these ticks.
  virtual void prepare(std::size_t tick, std::size_t ticks) noexcept = 0;
  /// The crossing of a lane that has entered a membrane in the direction b. axis: of the sample.
  virtual Crossing enter(std::size_t membrane, std::size_t lane, const Vector3d& b, const Vector3d& axis) noexcept = 0;
  /// See BasicRunSummary. axis: of the sample.
  virtual double through(std::size_t membrane, std::size_t lane, const Vector3d& axis) noexcept = 0;
  /// A lane has made its last tick. invalid: something happened that lanes do not compute, so its numbers are void.
  virtual void ended(std::size_t lane, bool invalid, const RunNumbers& run,
                     std::span<const MembraneNumbers> membranes) noexcept = 0;
  /// The forces of the model are in SceneBlock::force.
  virtual void keep(std::size_t tick, std::size_t ticks) noexcept = 0;
  virtual bool stopped() const noexcept = 0;

 protected:
  ~RunOwner() = default;
};

/// A block. SI.
struct SceneBlock {
  // The device and the hand. tip_steps: in a period.
  LaneNumbers encoder_step, max_force, tip_steps;
  BasicTipResponse<LaneNumbers> response;
  LaneNumbers tremor_a1, tremor_a2, tremor_b;
  LaneVectors phase, place;  ///< offset of the encoders, in steps; where the tip starts, m
  std::array<TickNoise, block_lanes> noise;
  // The servo step.
  LaneNumbers rate, period, low_pass_is_off, low_pass_gain, force_scale;
  std::uint32_t sub_steps;  ///< of a tick; lane by lane the same
  CouplingBlock coupling;
  std::vector<MembraneBlock> membranes;
  std::array<std::size_t, block_lanes> ticks;  ///< of each lane
  std::size_t trials;                          ///< lanes in use; those behind repeat the last one
  std::size_t width;                           ///< lanes that are computed, at most block_lanes

  // The inputs of scene_ticks ticks, and their forces.
  std::array<std::uint64_t, block_lanes> first_tick;  ///< the number of the tick of inputs[0]
  /// Of a lane whose desired motion is not in `inputs`, because it makes this one in all of these ticks: makes_stroke
  /// is 1, not 0.
  MinimumJerk<LaneNumbers, LaneVectors> stroke;
  LaneNumbers makes_stroke;
  struct Inputs {
    LaneVectors position, velocity;  ///< desired by the hand; without a hand, position is the given one
    Vector3d sample_axis, axis;      ///< of the sample, and as the model uses it
  };
  std::array<Inputs, scene_ticks> inputs;
  std::array<LaneVectors, scene_ticks> force;
  bool has_hand, keeps_force;
  bool fits_lines, from_motion;  ///< Conditioning::line_fit; Direction::motion
  LaneTrials* owner;             ///< what the lanes need from outside, seldom
};

/// Makes all ticks of a block, unless it is stopped.
using RunScene = void (*)(SceneBlock& block, RunOwner& owner);

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
