#include "punctura_runtime/batch/scene_batch.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "punctura/lab/plant/check.hpp"
#include "punctura/scene/values.hpp"
#include "punctura/servo/snapshot.hpp"
#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/batch/lane_trials.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/run_summary.hpp"

namespace punctura::batch {

namespace {

/// One thread's own scene, plant, hand and strokes, in which it sets the numbers of a trial.
class Trial {
 public:
  explicit Trial(const SceneBatch& all) : scene(all.scene), plant(all.plant), hand(all.hand), all_(all) {
    if (const auto* given = std::get_if<Strokes>(&all.motion)) strokes = *given;
    const std::map<std::string, double*> known = numbers();
    for (const Varied& one : all.varied) places_.push_back(known.at(one.path));
  }
  Trial(const Trial&) = delete;

  /// Every number that may differ from trial to trial, by its path.
  std::map<std::string, double*> numbers() {
    std::map<std::string, double*> known;
    for_each_value(scene, [&](const std::string& path, const Field&, double& number) { known[path] = &number; });
    const auto add = [&](const std::string& owner, const auto& fields, auto& values) {
      for (const auto& field : fields) known[owner + "." + std::string(field.name)] = &(values.*field.member);
    };
    const bool device = !std::holds_alternative<Positions>(all_.motion);
    if (device) add("plant", plant_fields, plant);
    if (device) add("hand", hand_fields, hand);
    if (std::holds_alternative<Strokes>(all_.motion)) add("strokes", strokes_fields, strokes);
    return known;
  }

  void set(std::size_t i) noexcept {
    for (std::size_t k = 0; k < places_.size(); ++k) *places_[k] = all_.varied[k].values[i];
  }

  std::vector<Problem> problems(std::size_t i) const {
    std::vector<Problem> found = punctura::check(scene);
    check_fields(plant_fields, plant, "plant", found);
    check_fields(hand_fields, hand, "hand", found);
    check_fields(strokes_fields, strokes, "strokes", found);
    if (!found.empty()) return found;
    const double seconds = duration(i);
    if (!(seconds * scene.servo.rate <= most_ticks))
      found.push_back({"duration", seconds, "is too long: a trial has at most 1e9 ticks, a week at 1600 Hz"});
    return found;
  }

  /// whole: the duration of the motion, s.
  std::size_t ticks(double whole) const noexcept {
    return static_cast<std::size_t>(
        std::llround((std::isnan(all_.duration) ? whole : all_.duration) * scene.servo.rate));
  }

  Scene scene;
  DeviceDynamics plant;
  Hand hand;
  Strokes strokes{};

 private:
  /// Of trial i, s, at a simulated device; 0 along positions.
  double duration(std::size_t i) const {
    if (std::holds_alternative<Positions>(all_.motion)) return 0;
    if (!std::isnan(all_.duration)) return all_.duration;
    if (const auto* recorded = std::get_if<RecordedMotion>(&all_.motion)) return recorded->duration();
    return StrokesMotion(strokes, all_.seeds[i]).duration();
  }

  const SceneBatch& all_;
  std::vector<double*> places_;
};

/// At most block_lanes trials that are run together.
class SceneTrials final : public LaneTrials, public RunOwner {
 public:
  /// stop: ends the run.
  SceneTrials(const SceneBatch& all, SceneResults& results, const std::atomic<bool>& stop)
      : LaneTrials(!std::holds_alternative<Positions>(all.motion)), all_(all), results_(results), stop_(stop) {
    block_->keeps_force = results.force != nullptr;
    alone_.reserve(block_lanes);
  }

  /// Adds trial i. Returns false, and adds nothing, if lanes cannot compute it beside the first one.
  bool add(std::size_t i, const Trial& trial) {
    const std::size_t lane = lanes_.size();
    LaneTrial* const put_there = put(lane, trial.scene, block_->has_hand ? all_.seeds[i] : 0);
    if (!put_there) return false;
    LaneTrial& own = *put_there;
    index_.push_back(i);
    std::size_t ticks = 0;
    if (const auto* given = std::get_if<Positions>(&all_.motion)) {
      own.motion = given->position + static_cast<std::ptrdiff_t>(i) * given->trial_stride;
      ticks = given->ticks;
    } else {
      if (const auto* recorded = std::get_if<RecordedMotion>(&all_.motion)) {
        own.motion = *recorded;
        ticks = trial.ticks(recorded->duration());
      } else {
        ticks = trial.ticks(own.motion.emplace<StrokesMotion>(trial.strokes, all_.seeds[i]).duration());
      }
      put_hand(lane, trial.plant, trial.hand, at(own, 0).position);
    }
    std::fill(block_->ticks.begin() + static_cast<std::ptrdiff_t>(lane), block_->ticks.end(), ticks);
    return true;
  }

  /// Runs all trials. Returns those that must be run again alone, because they came near a fault.
  const std::vector<std::size_t>& run(RunScene code) {
    code(*block_, *this);
    return alone_;
  }

  void prepare(std::size_t tick, std::size_t ticks) noexcept override {
    const auto* given = std::get_if<Positions>(&all_.motion);
    for (std::size_t k = 0; k < ticks && (given || tick == 0); ++k) {  // the axis of a hand stays
      SceneBlock::Inputs& to = block_->inputs[k];
      to.sample_axis =
          given ? Vector3d(given->axis + static_cast<std::ptrdiff_t>(tick + k) * given->axis_stride) : all_.axis;
      to.sample_axis = to.sample_axis.stableNormalized();
      to.axis = given ? to.sample_axis : to.sample_axis.stableNormalized();  // as the servo step does
    }
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) fill(lane, tick, ticks);
  }
  Crossing enter(std::size_t membrane, std::size_t lane, const Vector3d& b, const Vector3d& axis) noexcept override {
    return wall_of(membrane, lane).crossing(b, axis);
  }
  double through(std::size_t membrane, std::size_t lane, const Vector3d& axis) noexcept override {
    return wall_of(membrane, lane).through(axis);
  }
  void ended(std::size_t lane, bool invalid, const RunNumbers& run,
             std::span<const MembraneNumbers> membranes) noexcept override {
    const std::size_t i = index_[lane];
    if (invalid) return alone_.push_back(i);
    results_.runs[i] = run;
    results_.runs[i].in_lanes = true;
    std::copy(membranes.begin(), membranes.end(),
              results_.membranes.begin() + static_cast<std::ptrdiff_t>(i * membranes.size()));
  }
  void keep(std::size_t tick, std::size_t ticks) noexcept override {
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane)
      for (std::size_t k = 0; k < ticks && tick + k < block_->ticks[lane]; ++k)
        for (std::size_t j = 0; j < 3; ++j)
          results_.force[3 * (index_[lane] * block_->ticks[lane] + tick + k) + j] = block_->force[k][j].of[lane];
  }
  bool stopped() const noexcept override { return stop_; }

 private:
  const SceneBatch& all_;
  SceneResults& results_;
  const std::atomic<bool>& stop_;
  std::vector<std::size_t> index_;  ///< the number of each lane's trial
  std::vector<std::size_t> alone_;
};

class Runner {
 public:
  Runner(const SceneBatch& all, SceneResults& results, Work& work)
      : all_(all), results_(results), work_(work), trial_(all) {}

  void run(std::size_t i) {
    trial_.set(i);
    SceneSummary summary(trial_.scene, !std::holds_alternative<Positions>(all_.motion));
    if (std::holds_alternative<Strokes>(all_.motion)) {
      StrokesMotion motion(trial_.strokes, all_.seeds[i]);
      const double duration = motion.duration();
      experiment(i, std::move(motion), duration, summary);
    } else if (const auto* recorded = std::get_if<RecordedMotion>(&all_.motion)) {
      experiment(i, *recorded, recorded->duration(), summary);
    } else {
      along(i, std::get<Positions>(all_.motion), summary);
    }
    results_.runs[i] = summary.numbers();
    const std::size_t m = trial_.scene.membranes.size();
    for (std::size_t j = 0; j < m; ++j) results_.membranes[i * m + j] = summary.membrane(j);
  }

  /// Runs trials [from, to) in lanes, and those that lanes cannot compute alone.
  void run_lanes(RunScene code, std::size_t from, std::size_t to) {
    SceneTrials together(all_, results_, work_.stop);
    std::vector<std::size_t> alone;
    for (std::size_t i = from; i < to; ++i) {
      trial_.set(i);
      if (!together.add(i, trial_)) alone.push_back(i);
    }
    if (together.size() > 0) {
      const auto& again = together.run(code);
      alone.insert(alone.end(), again.begin(), again.end());
    }
    for (const std::size_t i : alone)
      if (!work_.stop) run(i);
  }

 private:
  template <typename Motion>
  void experiment(std::size_t i, Motion motion, double whole, SceneSummary& summary) {
    Experiment<Motion> one(trial_.scene, std::move(motion), all_.axis, trial_.plant, trial_.hand, all_.seeds[i]);
    const std::size_t ticks = trial_.ticks(whole);
    for (std::size_t k = 0; k < ticks && !work_.stop; ++k) {
      const Snapshot& s = one.step();
      summary.add(s);
      keep(i * ticks + k, s.model_force);
    }
  }

  void along(std::size_t i, const Positions& given, SceneSummary& summary) {
    Insertion insertion = build_insertion(trial_.scene);
    const double* p = given.position + static_cast<std::ptrdiff_t>(i) * given.trial_stride;
    Snapshot s{};
    s.membrane_count = static_cast<std::uint32_t>(insertion.size());
    for (std::size_t k = 0; k < given.ticks && !work_.stop; ++k) {
      const Vector3d axis(given.axis + static_cast<std::ptrdiff_t>(k) * given.axis_stride);
      s.tick = k;
      s.sample.time = static_cast<double>(k) / trial_.scene.servo.rate;
      s.sample.position = {p[3 * k], p[3 * k + 1], p[3 * k + 2]};
      s.sample.axis = to_array(axis.stableNormalized());
      s.model_force = to_array(insertion.step(to_vector(s.sample.position), to_vector(s.sample.axis)));
      s.tip = to_array(insertion.tip());
      for (std::size_t j = 0; j < s.membrane_count; ++j) s.membranes[j] = record_of(insertion.tick(j));
      summary.add(s);
      keep(i * given.ticks + k, s.model_force);
    }
  }

  void keep(std::size_t row, const std::array<double, 3>& force) noexcept {
    if (results_.force) std::copy(force.begin(), force.end(), results_.force + 3 * row);
  }

  const SceneBatch& all_;
  SceneResults& results_;
  Work& work_;
  Trial trial_;
};

/// Calls each(from, to) for all blocks of trials, on threads.
bool for_each_block_of_trials(const SceneBatch& all, const RunOptions& options, std::size_t block, Work& work,
                              const std::function<void(std::size_t, std::size_t)>& each) {
  bool stopped = false;
  std::function<bool()> watch;
  if (options.watch)
    watch = [&] {
      stopped = !options.watch(work.done, all.trials);
      return !stopped;
    };
  for_each_block((all.trials + block - 1) / block, usable_threads(options.threads), work,
                 [&](std::size_t index) { each(index * block, std::min(all.trials, (index + 1) * block)); }, watch);
  return !stopped;
}

}  // namespace

std::vector<std::string> paths(const SceneBatch& all) {
  std::vector<std::string> names;
  for (const auto& [path, number] : Trial({.scene = all.scene, .motion = all.motion}).numbers()) names.push_back(path);
  return names;
}

std::optional<TrialProblems> check(const SceneBatch& all, const RunOptions& options) {
  std::optional<TrialProblems> worst;
  std::mutex lock;
  Work work;
  RunOptions quiet = options;
  if (options.watch) quiet.watch = [&](std::size_t, std::size_t) { return options.watch(0, all.trials); };
  for_each_block_of_trials(all, quiet, 1024, work, [&](std::size_t from, std::size_t to) {
    Trial trial(all);
    for (std::size_t i = from; i < to && !work.stop; ++i, ++work.done) {
      trial.set(i);
      std::vector<Problem> problems = trial.problems(i);
      if (problems.empty()) continue;
      const std::lock_guard guard(lock);
      if (!worst || i < worst->trial) worst = {i, std::move(problems)};
      return;  // later trials of the block do not matter
    }
  });
  return worst;
}

bool run(const SceneBatch& all, SceneResults& results, const RunOptions& options) {
  results.runs.assign(all.trials, {});
  results.membranes.assign(all.trials * all.scene.membranes.size(), {});
  Work work;
  const LineCode& code = options.code ? *options.code : *line_codes().front();
  const RunScene lanes = code.scene_of(all.scene.servo.solver);
  const std::size_t block = std::max<std::size_t>(1, std::min<std::size_t>(options.block, block_lanes));
  return for_each_block_of_trials(all, options, block, work, [&](std::size_t from, std::size_t to) {
    Runner runner(all, results, work);
    if (lanes) {
      runner.run_lanes(lanes, from, to);
    } else {
      for (std::size_t i = from; i < to && !work.stop; ++i) runner.run(i);
    }
    work.done += to - from;
  });
}

}  // namespace punctura::batch
