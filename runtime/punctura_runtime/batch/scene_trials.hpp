// Trials of a scene, prepared for the lanes of a block.
#pragma once

#include <atomic>
#include <memory>
#include <variant>
#include <vector>

#include "punctura/plant/plant.hpp"
#include "punctura/scene/build.hpp"
#include "punctura_runtime/batch/lane_wall.hpp"
#include "punctura_runtime/batch/scene_batch.hpp"
#include "punctura_runtime/batch/scene_block.hpp"

namespace punctura::batch {

/// The numbers of a trial.
struct TrialNumbers {
  const Scene& scene;
  const DeviceDynamics& plant;
  const Hand& hand;
  const Strokes& strokes;
};

/// At most block_lanes trials that are computed together.
class SceneTrials final : public SceneOwner {
 public:
  /// stop: ends the run.
  SceneTrials(const SceneBatch& all, SceneResults& results, const std::atomic<bool>& stop);
  SceneTrials(const SceneTrials&) = delete;

  /// Adds trial i. Returns false, and adds nothing, if its coupling has not as many branches,
  /// or its tick not as many sub-steps, as those of the trials before it.
  bool add(std::size_t i, const TrialNumbers& numbers);
  std::size_t size() const noexcept { return block_->trials; }
  /// Runs all trials. Returns those that must be run again alone, because they came near a fault.
  const std::vector<std::size_t>& run(RunScene code);

  void prepare(std::size_t tick, std::size_t ticks) noexcept override;
  void lay_out(std::size_t membrane, std::size_t start, std::size_t lanes, const double* cosine) noexcept override;
  Vector3d fit(std::size_t lane, const Vector3d& measured) noexcept override;
  Vector3d direction(std::size_t lane, const Vector3d& tip) noexcept override;
  void advance(std::size_t membrane, std::size_t start, unsigned lanes, const double* depth) noexcept override;
  void leave(std::size_t membrane, std::size_t start, unsigned lanes) noexcept override;
  Crossing enter(std::size_t membrane, std::size_t lane, const Vector3d& b, const Vector3d& axis) noexcept override;
  double through(std::size_t membrane, std::size_t lane, const Vector3d& axis) noexcept override;
  void ended(std::size_t lane, bool strange, const RunNumbers& run,
             std::span<const MembraneNumbers> membranes) noexcept override;
  void keep(std::size_t tick, std::size_t ticks) noexcept override;
  bool stopped() const noexcept override { return stop_; }

 private:
  /// What a lane has beside its numbers in the block.
  struct LaneTrial {
    std::size_t index;
    double period;
    std::variant<const double*, StrokesMotion, RecordedMotion> motion;  ///< a pointer: given positions, m
    Noise noise;
    bool trembles;
    PositionConditioner<double> conditioner;
    EntryDirection<double> from_motion;
    std::vector<LaneWall> walls;
  };

  /// The desired motion of the hand in a tick, or the given position.
  static Desired at(LaneTrial& own, std::size_t tick) noexcept;
  void add_hand(LaneTrial& own, std::size_t lane, const TrialNumbers& numbers);
  LaneWall& wall_of(std::size_t membrane, std::size_t lane) noexcept {
    return lanes_[std::min(lane, lanes_.size() - 1)].walls[membrane];  // lanes without a trial follow the last one
  }
  /// The pieces or the fronts of a lane's wall have changed.
  void changed(std::size_t membrane, std::size_t lane) noexcept;

  const SceneBatch& all_;
  SceneResults& results_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<SceneBlock> block_;
  std::vector<LaneTrial> lanes_;
  std::vector<std::size_t> alone_;
};

}  // namespace punctura::batch
