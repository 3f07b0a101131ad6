#include "punctura_runtime/batch/lane_trials.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>
#include <variant>

namespace punctura::batch {

LaneWall::LaneWall(const Needle& needle, const PlacedMembrane& placed)
    : needle_(needle), placed_(placed), law_(needle, placed.membrane), pieces_(law_.pieces(1)) {
  if (is_k06(placed.tissue)) return;
  const SceneLaw<double> law(needle, placed.membrane, placed.tissue);
  tissue_ = std::make_unique<Tissue>(Tissue{law, law.pieces(1)});
}

bool LaneWall::lay_out(double cos_beta) noexcept {
  if (cos_beta == cos_beta_) return false;                  // the fronts are up to date
  if (!(cos_beta >= grazing_cosine<double>)) return false;  // it does not enter
  cos_beta_ = cos_beta;
  if (tissue_)
    tissue_->pieces = tissue_->law.pieces(cos_beta, tissue_->hole);
  else
    pieces_ = law_.pieces(cos_beta);
  return true;
}

void LaneWall::advance(double depth) noexcept {
  if (tissue_->law.advance(tissue_->hole, depth)) tissue_->law.refresh(tissue_->pieces, tissue_->hole);
}

void LaneWall::leave() noexcept {
  if (tissue_->law.leave(tissue_->hole)) tissue_->law.refresh(tissue_->pieces, tissue_->hole);
}

Crossing LaneWall::crossing(const Vector3d& b, const Vector3d& axis) const noexcept {
  if (tissue_) return crossing_along(tissue_->law, needle_, placed_, b, axis);
  return crossing_along(law_, needle_, placed_, b, axis);
}

double LaneWall::through(const Vector3d& axis) const noexcept {
  if (tissue_) return through_along(tissue_->law, needle_, placed_, axis);
  return through_along(law_, needle_, placed_, axis);
}

namespace {

/// How much of the model's force the device of a scene gives.
double scale_of(const Scene& scene) {
  const double scale = force_scale(scene, detail::model_of<double>(scene), ForceLimits{});
  return std::max(scale, std::numeric_limits<double>::min());
}

/// The desired motion of the hand in a tick. period: s.
template <typename Motion>
Desired desired(Motion& motion, double period, std::size_t tick) noexcept {
  if constexpr (std::is_pointer_v<Motion>)
    return {Vector3d(motion + 3 * tick), {}};  // given positions
  else
    return motion.at(static_cast<double>(tick) * period);
}

}  // namespace

LaneTrials::LaneTrials(bool has_hand, std::size_t width) : block_(std::make_unique<SceneBlock>()) {
  block_->trials = 0;
  block_->width = width;
  block_->keeps_force = false;
  block_->has_hand = has_hand;
  block_->owner = this;
  lanes_.reserve(block_lanes);
}

void LaneTrials::clear() noexcept {
  lanes_.clear();
  block_->trials = 0;
}

LaneTrials::LaneTrial* LaneTrials::put(std::size_t lane, const Scene& scene, std::uint64_t seed) {
  SceneBlock& b = *block_;
  const double rate = scene.servo.rate, period = 1 / rate;
  const auto coupling = detail::relaxing_coupling_of<double>(scene).constants();
  const bool fits_lines = scene.servo.conditioning == Conditioning::line_fit;
  const bool from_motion = scene.direction == Direction::motion;
  const auto sub_steps = static_cast<std::uint32_t>(scene.servo.sub_steps);
  if (lanes_.empty()) {
    b.membranes.assign(scene.membranes.size(), {});
    b.fits_lines = fits_lines;
    b.from_motion = from_motion;
    b.sub_steps = sub_steps;
    b.coupling.branches = coupling.count;
  } else if (scene.membranes.size() != b.membranes.size() || fits_lines != b.fits_lines ||
             from_motion != b.from_motion || sub_steps != b.sub_steps || coupling.count != b.coupling.branches) {
    return nullptr;
  }
  LaneTrial made{period,
                 nullptr,
                 {scene.servo.conditioning, scene.servo.low_pass, scene.servo.encoder_step, period},
                 EntryDirection<double>(period),
                 {}};
  made.walls.reserve(scene.membranes.size());
  for (const PlacedMembrane& placed : scene.membranes) made.walls.emplace_back(scene.needle, placed);
  if (lane == lanes_.size())
    lanes_.push_back(std::move(made));
  else
    lanes_[lane] = std::move(made);
  b.trials = lanes_.size();

  set(b.noise, lane, TickNoise(seed));
  set(b.makes_stroke, lane, 0);
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
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    const LaneWall& wall = lanes_[lane].walls[m];
    MembraneBlock& to = b.membranes[m];
    set(to.point, lane, to_vector(scene.membranes[m].point));
    set(to.normal, lane, to_vector(scene.membranes[m].inward_normal).stableNormalized());
    set(to.band.g, lane, coupling.g);
    to.remembers = to.remembers || wall.remembers();
    for (std::size_t each = lane; each < end_of(lane); ++each) {
      to.band.table[each] = wall.table();
      changed(m, each);
    }
  }
  return &lanes_[lane];
}

void LaneTrials::put_hand(std::size_t lane, const DeviceDynamics& plant, const Hand& hand, const Vector3d& start) {
  LaneTrial& own = lanes_[lane];
  SceneBlock& b = *block_;
  set(b.encoder_step, lane, plant.encoder_step);
  set(b.max_force, lane, plant.max_force);
  const std::uint32_t steps = tip_steps(plant, hand, own.period);
  const TipResponse response = tip_response(plant, hand, own.period / steps);
  set(b.tip_steps, lane, steps);
  set(b.response.time, lane, response.time);
  set(b.response.travel, lane, response.travel);
  set(b.response.kept, lane, response.kept);
  set(b.response.way, lane, response.way);
  set(b.response.velocity, lane, response.velocity);
  set(b.response.stiffness, lane, response.stiffness);
  set(b.response.damping, lane, response.damping);
  set(b.response.friction, lane, response.friction);
  const Tremor::Filter tremor = Tremor(hand, own.period).filter();
  set(b.tremor_a1, lane, tremor.a1);
  set(b.tremor_a2, lane, tremor.a2);
  set(b.tremor_b, lane, tremor.b);
  set(b.phase, lane, encoder_phase(b.noise[lane]));
  set(b.place, lane, start);
}

Desired LaneTrials::at(LaneTrial& own, std::size_t tick) noexcept {
  return std::visit([&](auto& motion) { return desired(motion, own.period, tick); }, own.motion);
}

void LaneTrials::fill(std::size_t lane, std::size_t tick, std::size_t ticks) noexcept {
  LaneTrial& own = lanes_[lane];
  SceneBlock& b = *block_;
  set(b.first_tick, lane, tick);
  const auto time = [&](std::size_t k) { return static_cast<double>(k) * own.period; };
  if (auto* strokes = std::get_if<StrokesMotion>(&own.motion)) {
    const double last = time(tick + ticks - 1);
    if (last < own.stroke_ends) return;
    const auto& stroke = strokes->segment(time(tick));
    own.stroke_ends = strokes->next_begin();
    const bool makes_stroke = last < own.stroke_ends;
    set(b.makes_stroke, lane, makes_stroke ? 1 : 0);
    if (makes_stroke) {
      set(b.stroke.begin, lane, stroke.begin);
      set(b.stroke.duration, lane, stroke.duration);
      set(b.stroke.from, lane, stroke.from);
      return set(b.stroke.to, lane, stroke.to);
    }
  }
  std::visit(
      [&](auto& motion) {
        for (std::size_t k = 0; k < ticks; ++k) {
          const Desired now = desired(motion, own.period, tick + k);
          set(b.inputs[k].position, lane, now.position);
          set(b.inputs[k].velocity, lane, now.velocity);
        }
      },
      own.motion);
}

void LaneTrials::set(LaneNumbers& numbers, std::size_t lane, double x) const noexcept {
  std::fill(numbers.of + lane, numbers.of + end_of(lane), x);
}
void LaneTrials::set(LaneVectors& vectors, std::size_t lane, const Vector3d& v) const noexcept {
  for (std::size_t j = 0; j < 3; ++j) set(vectors[j], lane, v[j]);
}

void LaneTrials::changed(std::size_t membrane, std::size_t lane) noexcept {
  MembraneBlock& to = block_->membranes[membrane];
  const LaneWall& wall = wall_of(membrane, lane);
  to.cut.of[lane] = wall.cut();
  to.made.of[lane] = wall.made();
  to.band.first.of[lane] = 1;  // no piece is present
  to.band.last.of[lane] = 0;
}

void LaneTrials::lay_out(std::size_t membrane, std::size_t start, std::size_t lanes, const double* cosine) noexcept {
  for (std::size_t lane = start; lane < start + lanes; ++lane)
    if (wall_of(membrane, lane).lay_out(cosine[lane - start]) || lane >= lanes_.size()) changed(membrane, lane);
}

Vector3d LaneTrials::fit(std::size_t lane, const Vector3d& measured) noexcept {
  return lanes_[lane].conditioner.step(measured);
}

Vector3d LaneTrials::direction(std::size_t lane, const Vector3d& tip) noexcept {
  return lanes_[lane].from_motion.step(tip);
}

void LaneTrials::advance(std::size_t membrane, std::size_t start, unsigned lanes, const double* depth) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    wall_of(membrane, start + i).advance(depth[i]);
    changed(membrane, start + i);
  }
}

void LaneTrials::leave(std::size_t membrane, std::size_t start, unsigned lanes) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const std::size_t lane = start + static_cast<std::size_t>(std::countr_zero(lanes));
    wall_of(membrane, lane).leave();
    changed(membrane, lane);
  }
}

}  // namespace punctura::batch
