// Whole runs of trials of a scene, prepared for the lanes of a block.
#pragma once

#include <atomic>
#include <vector>

#include "punctura_runtime/batch/lane_trials.hpp"
#include "punctura_runtime/batch/scene_batch.hpp"

namespace punctura::batch {

/// The numbers of a trial.
struct TrialNumbers {
  const Scene& scene;
  const DeviceDynamics& plant;
  const Hand& hand;
  const Strokes& strokes;
};

/// At most block_lanes trials that are run together.
class SceneTrials final : public LaneTrials, public RunOwner {
 public:
  /// stop: ends the run.
  SceneTrials(const SceneBatch& all, SceneResults& results, const std::atomic<bool>& stop);

  /// Adds trial i. Returns false, and adds nothing, if lanes cannot compute it beside the first one.
  bool add(std::size_t i, const TrialNumbers& numbers);
  /// Runs all trials. Returns those that must be run again alone, because they came near a fault.
  const std::vector<std::size_t>& run(RunScene code);

  void prepare(std::size_t tick, std::size_t ticks) noexcept override;
  Crossing enter(std::size_t membrane, std::size_t lane, const Vector3d& b, const Vector3d& axis) noexcept override;
  double through(std::size_t membrane, std::size_t lane, const Vector3d& axis) noexcept override;
  void ended(std::size_t lane, bool invalid, const RunNumbers& run,
             std::span<const MembraneNumbers> membranes) noexcept override;
  void keep(std::size_t tick, std::size_t ticks) noexcept override;
  bool stopped() const noexcept override { return stop_; }

 private:
  const SceneBatch& all_;
  SceneResults& results_;
  const std::atomic<bool>& stop_;
  std::vector<std::size_t> index_;  ///< the number of each lane's trial
  std::vector<std::size_t> alone_;
};

}  // namespace punctura::batch
