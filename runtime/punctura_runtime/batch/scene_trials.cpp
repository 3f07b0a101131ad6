#include "punctura_runtime/batch/scene_trials.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace punctura::batch {
namespace {

/// Sets the number of a lane and of all lanes behind it. So the lanes without a trial repeat the last one.
void set(LaneNumbers& numbers, std::size_t lane, double x) noexcept {
  std::fill(numbers.of + lane, numbers.of + block_lanes, x);
}
void set(LaneVectors& vectors, std::size_t lane, const Vector3d& v) noexcept {
  for (std::size_t j = 0; j < 3; ++j) set(vectors[j], lane, v[j]);
}

/// How much of the model's force the device of a scene gives.
double scale_of(const Scene& scene) {
  const double scale = scene.display.automatic ? automatic_force_scale(detail::model_of<double>(scene), ForceLimits{})
                                               : scene.display.force_scale;
  return std::max(scale, std::numeric_limits<double>::min());
}

}  // namespace

Desired SceneTrials::at(LaneTrial& own, std::size_t tick) noexcept {
  if (const auto* given = std::get_if<const double*>(&own.motion)) return {Vector3d(*given + 3 * tick), {}};
  const double time = static_cast<double>(tick) * own.period;
  if (auto* strokes = std::get_if<StrokesMotion>(&own.motion)) return strokes->at(time);
  return std::get_if<RecordedMotion>(&own.motion)->at(time);
}

SceneTrials::SceneTrials(const SceneBatch& all, SceneResults& results, const std::atomic<bool>& stop)
    : all_(all), results_(results), stop_(stop), block_(std::make_unique<SceneBlock>()) {
  block_->membranes.resize(all.scene.membranes.size());
  block_->trials = 0;
  block_->keeps_force = results.force != nullptr;
  block_->has_hand = !std::holds_alternative<Positions>(all.motion);
  block_->fits_lines = all.scene.servo.conditioning == Conditioning::line_fit;
  block_->from_motion = all.scene.direction == Direction::motion;
  block_->owner = this;
  lanes_.reserve(block_lanes);  // their pieces must stay where they are
  alone_.reserve(block_lanes);
}

bool SceneTrials::add(std::size_t i, const TrialNumbers& numbers) {
  const Scene& scene = numbers.scene;
  const std::size_t lane = lanes_.size();
  const double rate = scene.servo.rate, period = 1 / rate;
  SceneBlock& b = *block_;
  const auto coupling = detail::relaxing_coupling_of<double>(scene).constants();
  const auto sub_steps = static_cast<std::uint32_t>(scene.servo.sub_steps);
  if (lane > 0 && (coupling.count != b.coupling.branches || sub_steps != b.sub_steps)) return false;
  b.coupling.branches = coupling.count;
  b.sub_steps = sub_steps;
  LaneTrial& own =
      lanes_.emplace_back(LaneTrial{i,
                                    period,
                                    nullptr,
                                    Noise(b.has_hand ? all_.seeds[i] : 0),
                                    false,
                                    {scene.servo.conditioning, scene.servo.low_pass, scene.servo.encoder_step, period},
                                    EntryDirection<double>(period),
                                    {}});
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
      whole = own.motion.emplace<StrokesMotion>(numbers.strokes, all_.seeds[i]).duration();
    }
    ticks = static_cast<std::size_t>(std::llround((std::isnan(all_.duration) ? whole : all_.duration) * rate));
    add_hand(own, lane, numbers);
  }
  std::fill(b.ticks.begin() + static_cast<std::ptrdiff_t>(lane), b.ticks.end(), ticks);
  set(b.rate, lane, rate);
  set(b.period, lane, period);
  const LowPass<double, Vector3d> low_pass(scene.servo.low_pass, period);
  set(b.low_pass_is_off, lane, scene.servo.low_pass == 0 ? 1 : 0);
  set(b.low_pass_gain, lane, low_pass.gain());
  set(b.force_scale, lane, scale_of(scene));

  set(b.coupling.K, lane, coupling.K);
  set(b.coupling.g, lane, coupling.g);
  set(b.coupling.inv_g, lane, coupling.inv_g);
  set(b.coupling.free_share, lane, coupling.free_share);
  for (std::size_t j = 0; j < coupling.count; ++j) {
    set(b.coupling.a[j], lane, coupling.branches[j].a);
    set(b.coupling.k[j], lane, coupling.branches[j].k);
  }
  own.walls.reserve(scene.membranes.size());
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    const PlacedMembrane& placed = scene.membranes[m];
    const LaneWall& wall = own.walls.emplace_back(scene.needle, placed);
    MembraneBlock& to = b.membranes[m];
    set(to.point, lane, to_vector(placed.point));
    set(to.normal, lane, to_vector(placed.inward_normal).stableNormalized());
    set(to.band.g, lane, coupling.g);
    std::fill(to.band.table + lane, to.band.table + block_lanes, wall.table());
    to.remembers = to.remembers || wall.remembers();
    for (std::size_t each = lane; each < block_lanes; ++each) changed(m, each);
  }
  b.trials = lanes_.size();
  return true;
}

void SceneTrials::add_hand(LaneTrial& own, std::size_t lane, const TrialNumbers& numbers) {
  const auto& [scene, plant, hand, strokes] = numbers;
  SceneBlock& b = *block_;
  set(b.device_mass, lane, plant.mass);
  set(b.friction, lane, plant.friction);
  set(b.encoder_step, lane, plant.encoder_step);
  set(b.max_force, lane, plant.max_force);
  set(b.mass, lane, hand.mass);
  set(b.damping, lane, hand.damping);
  set(b.stiffness, lane, hand.stiffness);
  set(b.h, lane, own.period / Plant::substeps);
  const Tremor::Filter tremor = Tremor(hand, own.period).filter();
  set(b.tremor_a1, lane, tremor.a1);
  set(b.tremor_a2, lane, tremor.a2);
  set(b.tremor_b, lane, tremor.b);
  own.trembles = tremor.b != 0;
  set(b.phase, lane, own.noise.uniform_vector());
  set(b.place, lane, at(own, 0).position);
}

const std::vector<std::size_t>& SceneTrials::run(RunScene code) {
  code(*block_);
  return alone_;
}

void SceneTrials::prepare(std::size_t tick, std::size_t ticks) noexcept {
  const auto* given = std::get_if<Positions>(&all_.motion);
  for (std::size_t k = 0; k < ticks; ++k) {
    SceneBlock::Inputs& to = block_->inputs[k];
    to.told_axis =
        given ? Vector3d(given->axis + static_cast<std::ptrdiff_t>(tick + k) * given->axis_stride) : all_.axis;
    to.told_axis = to.told_axis.stableNormalized();
    to.axis = given ? to.told_axis : to.told_axis.stableNormalized();  // as the servo step does
  }
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    LaneTrial& own = lanes_[lane];
    const std::size_t behind = lane + 1 < lanes_.size() ? lane + 1 : block_lanes;
    const auto store = [&](LaneVectors& to, const Vector3d& v) {
      for (std::size_t j = 0; j < 3; ++j) std::fill(to[j].of + lane, to[j].of + behind, v[j]);
    };
    for (std::size_t k = 0; k < ticks; ++k) {
      SceneBlock::Inputs& to = block_->inputs[k];
      const Desired desired = at(own, tick + k);
      store(to.position, desired.position);
      if (given) continue;
      store(to.velocity, desired.velocity);
      Vector3d u, v;
      for (std::size_t j = 3; own.trembles && j-- > 0;) {  // in the order of Noise::normal_vector()
        u[j] = own.noise.uniform();
        v[j] = own.noise.uniform();
      }
      store(to.noise[0], u);
      store(to.noise[1], v);
    }
  }
}

void SceneTrials::changed(std::size_t membrane, std::size_t lane) noexcept {
  MembraneBlock& to = block_->membranes[membrane];
  const LaneWall& wall = wall_of(membrane, lane);
  to.cut.of[lane] = wall.cut();
  to.made.of[lane] = wall.made();
  to.band.first.of[lane] = 1;  // no piece is present
  to.band.last.of[lane] = 0;
}

void SceneTrials::lay_out(std::size_t membrane, std::size_t start, std::size_t lanes, const double* cosine) noexcept {
  for (std::size_t lane = start; lane < start + lanes; ++lane)
    if (wall_of(membrane, lane).lay_out(cosine[lane - start]) || lane >= lanes_.size()) changed(membrane, lane);
}

Vector3d SceneTrials::fit(std::size_t lane, const Vector3d& measured) noexcept {
  return lanes_[lane].conditioner.step(measured);
}

Vector3d SceneTrials::direction(std::size_t lane, const Vector3d& tip) noexcept {
  return lanes_[lane].from_motion.step(tip);
}

void SceneTrials::advance(std::size_t membrane, std::size_t start, unsigned lanes, const double* depth) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    wall_of(membrane, start + i).advance(depth[i]);
    changed(membrane, start + i);
  }
}

void SceneTrials::leave(std::size_t membrane, std::size_t start, unsigned lanes) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const std::size_t lane = start + static_cast<std::size_t>(std::countr_zero(lanes));
    wall_of(membrane, lane).leave();
    changed(membrane, lane);
  }
}

Crossing SceneTrials::enter(std::size_t membrane, std::size_t lane, const Vector3d& b, const Vector3d& axis) noexcept {
  return wall_of(membrane, lane).crossing(b, axis);
}

double SceneTrials::through(std::size_t membrane, std::size_t lane, const Vector3d& axis) noexcept {
  return wall_of(membrane, lane).through(axis);
}

void SceneTrials::ended(std::size_t lane, bool strange, const RunNumbers& run,
                        std::span<const MembraneNumbers> membranes) noexcept {
  const std::size_t i = lanes_[lane].index;
  if (strange) return alone_.push_back(i);
  results_.runs[i] = run;
  results_.runs[i].in_lanes = true;
  std::copy(membranes.begin(), membranes.end(),
            results_.membranes.begin() + static_cast<std::ptrdiff_t>(i * membranes.size()));
}

void SceneTrials::keep(std::size_t tick, std::size_t ticks) noexcept {
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane)
    for (std::size_t k = 0; k < ticks && tick + k < block_->ticks[lane]; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        results_.force[3 * (lanes_[lane].index * block_->ticks[lane] + tick + k) + j] = block_->force[k][j].of[lane];
}

}  // namespace punctura::batch
