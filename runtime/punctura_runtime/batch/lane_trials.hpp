// Trials that are computed together in the lanes of a block: their numbers, motions, noise and walls.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/model.hpp"
#include "punctura_runtime/batch/line_block.hpp"
#include "punctura_runtime/batch/run_summary.hpp"
#include "punctura_runtime/batch/scene_block.hpp"

namespace punctura::batch {

/// A membrane of a trial. Its table holds pointers into it, so it must stay where it is.
class LaneWall {
 public:
  LaneWall(const Needle& needle, const PlacedMembrane& placed);

  BandTable table() const noexcept { return tissue_ ? table_of(tissue_->pieces) : table_of(pieces_); }
  /// Computes the pieces for a needle that enters with n.b = cos_beta. Returns whether they change.
  bool lay_out(double cos_beta) noexcept;

  /// Whether it ever changes by the way of the needle. advance(), leave(): see BasicTissueLaw.
  bool remembers() const noexcept { return tissue_ && tissue_->law.remembers(); }
  void advance(double depth) noexcept;
  void leave() noexcept;
  /// The fronts of BasicHole, m; infinite if it does not remember.
  double cut() const noexcept { return remembers() ? tissue_->hole.cut : infinity; }
  double made() const noexcept { return remembers() ? tissue_->hole.made : infinity; }

  /// See BasicRunSummary. axis: of the sample.
  Crossing crossing(const Vector3d& b, const Vector3d& axis) const noexcept;
  double through(const Vector3d& axis) const noexcept;

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// A wall beyond K06.
  struct Tissue {
    SceneLaw<double> law;
    SceneLaw<double>::Pieces pieces;
    SceneLaw<double>::Memory hole{};
  };

  Needle needle_;
  PlacedMembrane placed_;
  double cos_beta_ = 1;  // of the pieces
  ThickLaw law_;
  ThickLaw::Pieces pieces_;
  std::unique_ptr<Tissue> tissue_;
};

/// At most block_lanes trials, each in its lane.
class LaneTrials {
 public:
  LaneTrials(const LaneTrials&) = delete;
  std::size_t size() const noexcept { return block_->trials; }

  // For the lanes of the block.
  /// Lane start + i of `lanes` lanes has entered a membrane with n.b = cosine[i], perhaps long ago.
  void lay_out(std::size_t membrane, std::size_t start, std::size_t lanes, const double* cosine) noexcept;
  /// The line fit of a lane, for SceneBlock::fits_lines: its conditioned position, m.
  Vector3d fit(std::size_t lane, const Vector3d& measured) noexcept;
  /// The direction of a lane's motion, for SceneBlock::from_motion.
  Vector3d direction(std::size_t lane, const Vector3d& tip) noexcept;
  /// The lanes of `lanes` (bits, from `start`) have reached these depths (m) in a membrane that remembers.
  void advance(std::size_t membrane, std::size_t start, unsigned lanes, const double* depth) noexcept;
  /// They have left it in front.
  void leave(std::size_t membrane, std::size_t start, unsigned lanes) noexcept;

 protected:
  /// What a lane has beside its numbers in the block.
  struct LaneTrial {
    double period;
    std::variant<const double*, StrokesMotion, RecordedMotion, Steered> motion;  ///< a pointer: given positions, m
    PositionConditioner<double> conditioner;
    EntryDirection<double> from_motion;
    std::vector<LaneWall> walls;
    double stroke_ends = 0;  ///< s: SceneBlock::stroke holds until the next movement begins
  };

  /// width: the most trials, a multiple of the lanes of a vector.
  explicit LaneTrials(bool has_hand, std::size_t width = block_lanes);
  ~LaneTrials() = default;

  /// Puts a trial into a lane, with what does not need a hand. lane: at most size(), for a new one. The lanes without
  /// a trial repeat the last one. seed: of the noise. Returns null, and puts nothing, if the trial cannot be computed
  /// beside the first one: it needs as many membranes, branches of the coupling and sub-steps, and the same kind of
  /// conditioning and direction.
  LaneTrial* put(std::size_t lane, const Scene& scene, std::uint64_t seed);
  /// Sets hand and device of a lane. start: the place of the tip, m.
  void put_hand(std::size_t lane, const DeviceDynamics& plant, const Hand& hand, const Vector3d& start);
  /// Computes the inputs of a lane for `ticks` ticks, of which the first is this tick of the trial.
  void fill(std::size_t lane, std::size_t tick, std::size_t ticks) noexcept;
  /// The desired motion of the hand in a tick, or the given position.
  static Desired at(LaneTrial& own, std::size_t tick) noexcept;
  LaneWall& wall_of(std::size_t membrane, std::size_t lane) noexcept {
    return lanes_[std::min(lane, lanes_.size() - 1)].walls[membrane];
  }
  /// The end of this lane and of those that repeat it.
  std::size_t end_of(std::size_t lane) const noexcept { return lane + 1 < lanes_.size() ? lane + 1 : block_->width; }
  /// Removes all trials.
  void clear() noexcept;

  std::unique_ptr<SceneBlock> block_;
  std::vector<LaneTrial> lanes_;

 private:
  /// Set a number of a lane, and of those that repeat it.
  void set(LaneNumbers& numbers, std::size_t lane, double x) const noexcept;
  template <typename T>
  void set(std::array<T, block_lanes>& values, std::size_t lane, std::type_identity_t<T> x) const noexcept {
    std::fill(values.data() + lane, values.data() + end_of(lane), x);
  }
  void set(LaneVectors& vectors, std::size_t lane, const Vector3d& v) const noexcept;
  /// The pieces or the fronts of a lane's wall have changed.
  void changed(std::size_t membrane, std::size_t lane) noexcept;
};

}  // namespace punctura::batch
