// Many runs of a scene, each with some numbers of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/batch/run_summary.hpp"

namespace punctura::batch {

/// A number that differs from trial to trial. path: of for_each_value(), or "plant.mass", "hand.stiffness",
/// "strokes.duration" and so on.
struct Varied {
  std::string path;
  std::vector<double> values;  ///< one for each trial, SI
};

/// Measured positions, the same for all trials or some for each.
struct Positions {
  const double* position;  ///< m; number j of tick k of trial i is at [i * trial_stride + 3 k + j]
  std::ptrdiff_t trial_stride;
  const double* axis;  ///< direction of the needle, of any length but 0; of tick k at [axis_stride * k]
  std::ptrdiff_t axis_stride;
  std::size_t ticks;
};

/// What to run: a hand with a simulated device (Strokes, RecordedMotion), or the model along positions.
struct SceneBatch {
  using Motion = std::variant<Strokes, RecordedMotion, Positions>;

  Scene scene;
  Motion motion;
  std::size_t trials = 1;
  std::vector<Varied> varied{};
  Vector3d axis{};  ///< of the stylus, with a simulated device
  DeviceDynamics plant{};
  Hand hand{};
  std::vector<std::uint64_t> seeds{};  ///< one for each trial, with a simulated device
  double duration = not_given;         ///< s, with a simulated device; NaN: as long as the motion lasts
};

/// The results: one element for each trial, and for each membrane of each trial.
struct SceneResults {
  std::vector<RunNumbers> runs;
  std::vector<MembraneNumbers> membranes;
  double* force = nullptr;  ///< if not null, the model's force of each tick: N, (trials, ticks, 3)
};

/// The problems of one trial.
struct TrialProblems {
  std::size_t trial;
  std::vector<Problem> problems;
};

/// Most ticks of a trial: a week at 1600 Hz. A longer one is a mistake in the unit of its duration.
inline constexpr double most_ticks = 1e9;

/// The paths of the numbers that may differ from trial to trial.
std::vector<std::string> paths(const SceneBatch& all);

/// Checks all trials. Returns the problems of the first trial that has some. Throws std::out_of_range for a path that
/// is not one of paths().
std::optional<TrialProblems> check(const SceneBatch& all, const RunOptions& options);

/// Runs all trials, which must have passed check(). Returns false if watch() stopped it.
bool run(const SceneBatch& all, SceneResults& results, const RunOptions& options);

}  // namespace punctura::batch
