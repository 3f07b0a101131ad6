// One trial of a fleet, computed alone: an experiment that a program steers along the needle, and what happened in its
// last step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "punctura/lab/plant/experiment.hpp"

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

}  // namespace punctura::batch
