// Many simulated operators that a program steers at once, in lanes and on threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/batch/lane_trials.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/scene_block.hpp"

namespace punctura::batch {

/// What happened in a step of a trial.
struct TrialRecord {
  double force = 0;             ///< of the last tick, N: what the device gives against the needle's direction
  double lowest_force = 0;      ///< the smallest such force in the step, N
  double highest_force = 0;     ///< the largest such force in the step, N
  double travel = 0;            ///< measured way along the needle since the start, m
  double speed = 0;             ///< mean of the measured speed along the needle in the step, m/s
  Fault fault = Fault::none;    ///< the latched fault of the servo step
  std::vector<double> depth;    ///< of each membrane after the step, m, see SpaceTick::depth
  std::vector<double> deepest;  ///< of each membrane, the largest depth in the step, m
};

/// What made a trial what it is. It says the trial to the bit, on every machine and instruction set.
struct TrialHistory {
  /// Ticks with one speed of the hand along the needle, m/s.
  struct Move {
    double speed;
    std::size_t ticks;
  };

  Scene scene;
  Vector3d start;  ///< place of the tip, m
  std::uint64_t seed;
  std::vector<Move> moves{};
  std::size_t ticks = 0;  ///< of all moves
  std::size_t begun = 0;  ///< of those before the last begin(), where a move ends

  void begin() noexcept { begun = ticks; }
  void step(double speed, std::size_t more) {
    if (ticks != begun && moves.back().speed == speed)
      moves.back().ticks += more;
    else
      moves.push_back({speed, more});
    ticks += more;
  }
};

/// An experiment whose hand moves along the needle with a speed that a program sets.
class FleetTrial {
 public:
  /// axis: direction of the needle, of length 1. The scene must have passed check().
  FleetTrial(const Scene& scene, const Vector3d& start, const Vector3d& axis, const DeviceDynamics& plant,
             const Hand& hand, std::uint64_t seed)
      : experiment_(scene, Steered(start), axis, plant, hand, seed),
        start_(start),
        axis_(axis.stableNormalized()),
        period_(1 / scene.servo.rate) {
    record_.depth.resize(scene.membranes.size());
    record_.deepest.resize(scene.membranes.size());
    begin();
  }

  /// Starts the record of a step.
  void begin() noexcept {
    travel_before_ = record_.travel;
    record_.lowest_force = std::numeric_limits<double>::infinity();
    record_.highest_force = -std::numeric_limits<double>::infinity();
    std::fill(record_.deepest.begin(), record_.deepest.end(), -std::numeric_limits<double>::infinity());
  }

  /// Makes `ticks` ticks, at least one, while the hand moves with `speed` (m/s) along the needle.
  void step(double speed, std::size_t ticks) noexcept {
    experiment_.motion().steer(speed * axis_);
    for (std::size_t k = 0; k < ticks; ++k) {
      const Snapshot& tick = experiment_.step();
      const double force = -axis_.dot(to_vector(tick.force));
      record_.force = force;
      record_.lowest_force = std::min(record_.lowest_force, force);
      record_.highest_force = std::max(record_.highest_force, force);
      for (std::size_t i = 0; i < record_.deepest.size(); ++i)
        record_.deepest[i] = std::max(record_.deepest[i], tick.membranes[i].depth);
    }
    const Snapshot& last = experiment_.servo().snapshot();
    record_.travel = axis_.dot(to_vector(last.sample.position) - start_);
    record_.fault = last.fault;
    for (std::size_t i = 0; i < record_.depth.size(); ++i) record_.depth[i] = last.membranes[i].depth;
  }

  /// The record of a step of `ticks` ticks in all.
  TrialRecord record(std::size_t ticks) const {
    TrialRecord record = record_;
    record.speed = (record.travel - travel_before_) / (static_cast<double>(ticks) * period_);
    return record;
  }

 private:
  Experiment<Steered> experiment_;
  Vector3d start_, axis_;
  double period_, travel_before_ = 0;
  TrialRecord record_;
};

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
