// Trials of a fleet that are computed together: in the lanes of a block, or each alone.
#pragma once

#include <memory>
#include <vector>

#include "punctura_runtime/batch/fleet_lanes.hpp"
#include "punctura_runtime/batch/fleet_trial.hpp"
#include "punctura_runtime/batch/lane_trials.hpp"
#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::batch {

/// What all trials of a fleet have in common.
struct FleetSetup {
  DeviceDynamics plant{};
  Hand hand{};
  Vector3d axis{0, -1, 0};         ///< the needle's direction, of length 1
  const LineCode* code = nullptr;  ///< null: the fastest instruction set; Fleet replaces it
};

/// At most width() trials.
///
/// A trial is computed alone if the instruction set has no code for lanes, if its scene does not fit beside the others,
/// or from the step on in which it came near a fault. A lane keeps no states of the past. Therefore such a trial makes
/// all its ticks again, alone, from its history: 16 bytes for each step since its start.
class FleetBlock final : public LaneTrials {
 public:
  /// The trials of a block: two vectors, so that many threads find work; without lanes, enough for a thread.
  static std::size_t width(const LineCode& code) noexcept { return code.fleet_exact ? 2 * code.lanes : 8; }

  explicit FleetBlock(const FleetSetup& setup);

  /// Starts a trial anew, or adds one (i = number of trials). If no other trial is in the lanes, they take the kind of
  /// this scene.
  void place(std::size_t i, const Scene& scene, const Vector3d& start, std::uint64_t seed);
  /// Starts the record of a step.
  void begin();
  /// Makes ticks. speed: of the hand along the needle, m/s, one for each trial.
  void step(const double* speed, std::size_t ticks);
  /// What happened since begin(). ticks: since then.
  TrialRecord record(std::size_t i, std::size_t ticks) const;
  bool in_lanes(std::size_t i) const noexcept { return !trials_[i].alone; }
  const TrialHistory& history(std::size_t i) const noexcept { return trials_[i].history; }

 private:
  static constexpr std::size_t no_lane = ~std::size_t{0};
  struct Trial {
    TrialHistory history;
    std::size_t lane = no_lane;
    std::unique_ptr<FleetTrial> alone{};  ///< null while lanes compute it
    double travel = 0;                    ///< at begin(), m
  };

  /// A trial alone, after its history.
  std::unique_ptr<FleetTrial> make(const TrialHistory& history) const;

  FleetSetup setup_;
  std::vector<Trial> trials_;
  MakeFleet code_ = nullptr;
  Solver solver_ = Solver::exact;      ///< of all lanes
  std::unique_ptr<FleetLanes> state_;  ///< null until a trial needs lanes
};

}  // namespace punctura::batch
