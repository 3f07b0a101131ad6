#include "punctura_runtime/batch/scene_trials.hpp"

#include <algorithm>

namespace punctura::batch {

SceneTrials::SceneTrials(const SceneBatch& all, SceneResults& results, const std::atomic<bool>& stop)
    : LaneTrials(!std::holds_alternative<Positions>(all.motion)), all_(all), results_(results), stop_(stop) {
  block_->keeps_force = results.force != nullptr;
  alone_.reserve(block_lanes);
}

bool SceneTrials::add(std::size_t i, const TrialNumbers& numbers) {
  const auto& [scene, plant, hand, strokes] = numbers;
  const std::size_t lane = lanes_.size();
  LaneTrial* const put_there = put(lane, scene, block_->has_hand ? all_.seeds[i] : 0);
  if (!put_there) return false;
  LaneTrial& own = *put_there;
  index_.push_back(i);
  std::size_t ticks = 0;
  if (const auto* given = std::get_if<Positions>(&all_.motion)) {
    own.motion = given->position + static_cast<std::ptrdiff_t>(i) * given->trial_stride;
    ticks = given->ticks;
  } else {
    double whole = 0;
    if (const auto* recorded = std::get_if<RecordedMotion>(&all_.motion)) {
      own.motion = *recorded;
      whole = recorded->duration();
    } else {
      whole = own.motion.emplace<StrokesMotion>(strokes, all_.seeds[i]).duration();
    }
    const double duration = std::isnan(all_.duration) ? whole : all_.duration;
    ticks = static_cast<std::size_t>(std::llround(duration * scene.servo.rate));
    put_hand(lane, plant, hand, at(own, 0).position);
  }
  std::fill(block_->ticks.begin() + static_cast<std::ptrdiff_t>(lane), block_->ticks.end(), ticks);
  return true;
}

const std::vector<std::size_t>& SceneTrials::run(RunScene code) {
  code(*block_, *this);
  return alone_;
}

void SceneTrials::prepare(std::size_t tick, std::size_t ticks) noexcept {
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

Crossing SceneTrials::enter(std::size_t membrane, std::size_t lane, const Vector3d& b, const Vector3d& axis) noexcept {
  return wall_of(membrane, lane).crossing(b, axis);
}

double SceneTrials::through(std::size_t membrane, std::size_t lane, const Vector3d& axis) noexcept {
  return wall_of(membrane, lane).through(axis);
}

void SceneTrials::ended(std::size_t lane, bool invalid, const RunNumbers& run,
                        std::span<const MembraneNumbers> membranes) noexcept {
  const std::size_t i = index_[lane];
  if (invalid) return alone_.push_back(i);
  results_.runs[i] = run;
  results_.runs[i].in_lanes = true;
  std::copy(membranes.begin(), membranes.end(),
            results_.membranes.begin() + static_cast<std::ptrdiff_t>(i * membranes.size()));
}

void SceneTrials::keep(std::size_t tick, std::size_t ticks) noexcept {
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane)
    for (std::size_t k = 0; k < ticks && tick + k < block_->ticks[lane]; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        results_.force[3 * (index_[lane] * block_->ticks[lane] + tick + k) + j] = block_->force[k][j].of[lane];
}

}  // namespace punctura::batch
