// One tick of some trials of a scene, in lanes: conditioning and model, and with a simulated hand also plant and force
// limits, as Experiment has them.
//
// A fault never happens here. A lane that comes near one is marked as invalid, and its trial is computed again alone.
#pragma once

#include <algorithm>
#include <vector>

#include "punctura/lab/events/contact.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"
#include "punctura/signal/low_pass.hpp"
#include "punctura_runtime/batch/lane_trials.hpp"
#include "punctura_runtime/batch/present_pieces.hpp"
#include "punctura_runtime/batch/scene_block.hpp"
#include "punctura_runtime/batch/simd.hpp"

namespace punctura::batch {

template <typename V>
V at(const LaneNumbers& numbers, std::size_t lane) noexcept {
  return V::load(numbers.of + lane);
}
template <typename V>
Vector3<V> at(const LaneVectors& vectors, std::size_t lane) noexcept {
  return {at<V>(vectors[0], lane), at<V>(vectors[1], lane), at<V>(vectors[2], lane)};
}
template <typename V>
void store(const Vector3<V>& v, LaneVectors& to, std::size_t lane) noexcept {
  for (std::size_t j = 0; j < 3; ++j) v[j].store(to[j].of + lane);
}
template <typename V>
Vector3<V> same(const Vector3d& v) noexcept {
  return {V(v.x()), V(v.y()), V(v.z())};
}

/// The law of a membrane for the solvers of core.
template <typename V>
class SpaceLaw {
 public:
  using Scalar = V;
  using Pieces = PresentPieces<V, true>;
  SpaceLaw(SceneBlock& block, std::size_t membrane, std::size_t start) noexcept
      : block_(&block), membrane_(membrane), start_(start) {}

  Pieces pieces() const noexcept { return {block_->membranes[membrane_].band, start_}; }
  /// For lanes that enter with n.b = cos_beta. Other lanes have the cos_beta that they had.
  Pieces pieces(const V& cos_beta) const noexcept {
    alignas(64) double cosine[V::lanes];
    cos_beta.store(cosine);
    block_->owner->lay_out(membrane_, start_, V::lanes, cosine);
    return pieces();
  }

  /// For LanesThatRemember.
  bool remembers() const noexcept { return block_->membranes[membrane_].remembers; }
  void advance(const V& depth, const typename V::Mask& lanes) const noexcept {
    const auto deeper = lanes && depth > at<V>(block_->membranes[membrane_].cut, start_);
    if (!any(deeper)) return;
    alignas(64) double reached[V::lanes];
    depth.store(reached);
    block_->owner->advance(membrane_, start_, deeper.bits(), reached);
  }
  void leave(const typename V::Mask& lanes) const noexcept {
    const MembraneBlock& membrane = block_->membranes[membrane_];
    const auto left = lanes && at<V>(membrane.made, start_) < at<V>(membrane.cut, start_);
    if (any(left)) block_->owner->leave(membrane_, start_, left.bits());
  }

 private:
  SceneBlock* block_;
  std::size_t membrane_, start_;
};

/// Some trials of a block, one in each lane: their state, and the results of the last tick.
template <typename V, typename Solver>
class SceneLanes {
 public:
  using Vector = Vector3<V>;
  using Truth = typename V::Mask;

  /// start: the first lane in the block. All lanes are before their first tick.
  SceneLanes(SceneBlock& block, std::size_t start)
      : block_(block),
        start_(start),
        gate_({}, V(1), false),
        limiter_({}, V(1)),
        states_(block.membranes.size()),
        ticks_(block.membranes.size()) {
    params_.reserve(states_.size());
    restart(Truth(true));
  }

  /// Starts these lanes anew, with the numbers that are in the block now.
  void restart(const Truth& lanes) noexcept {
    const auto number = [&](const LaneNumbers& numbers) { return at<V>(numbers, start_); };
    number_ = select(lanes, V(0), number_);
    tip_.x = select(lanes, at<V>(block_.place, start_), tip_.x);
    tip_.v = select(lanes, Vector(), tip_.v);
    tremor_.restart(lanes, {number(block_.tremor_a1), number(block_.tremor_a2), number(block_.tremor_b)});
    // The numbers of the block are new in these lanes; the other lanes go on.
    const auto renew = [&](auto& old, auto made) {
      made.state = old.state;
      made.restart(lanes);
      old = made;
    };
    const V spent = limiter_.budget().spent();
    renew(low_pass_, LowPass<V, Vector>::of_gain(!(number(block_.low_pass_is_off) == 0), number(block_.low_pass_gain)));
    renew(gate_, BasicInputGate<V>({}, number(block_.period), false));
    renew(limiter_, Limiter({}, number(block_.period)));
    limiter_.set_spent(select(lanes, V(0), spent));
    // A lane makes one step of the plant in a period: very stiff grips need more.
    valid_ = (valid_ || lanes) && number(block_.tip_steps) <= 1;
    time_ = select(lanes, V(0), time_);  // no time has passed in a first tick
    active_ = active_ && !lanes;
    for (State& state : states_) restart(state, lanes);
    params_.clear();
    for (std::size_t i = 0; i < states_.size(); ++i)
      params_.push_back({Law(block_, i, start_), at<V>(block_.membranes[i].point, start_),
                         at<V>(block_.membranes[i].normal, start_), coupling()});
  }

  /// Computes what the block does not have of the inputs of these ticks.
  void prepare(std::size_t ticks) noexcept {
    for (std::size_t i = 0; i < V::lanes; ++i) noise_[i] = block_.noise[start_ + i].from(block_.first_tick[start_ + i]);
    const auto number = [&](const LaneNumbers& numbers) { return at<V>(numbers, start_); };
    const Truth given = number(block_.makes_stroke) == 0;
    if (all(given)) return;
    const MinimumJerk<V> stroke{number(block_.stroke.begin), number(block_.stroke.duration),
                                at<V>(block_.stroke.from, start_), at<V>(block_.stroke.to, start_)};
    alignas(64) double first[V::lanes];
    for (std::size_t i = 0; i < V::lanes; ++i) first[i] = static_cast<double>(block_.first_tick[start_ + i]);
    const V tick = V::load(first), period = number(block_.period);
    for (std::size_t k = 0; k < ticks; ++k) {
      SceneBlock::Inputs& to = block_.inputs[k];
      BasicDesired<V> now = stroke.at((tick + V(static_cast<double>(k))) * period);
      if (any(given))
        now = {select(given, at<V>(to.position, start_), now.position),
               select(given, at<V>(to.velocity, start_), now.velocity)};
      store(now.position, to.position, start_);
      store(now.velocity, to.velocity, start_);
    }
  }

  /// One tick. k: of SceneBlock::inputs.
  void step(std::size_t k) noexcept {
    const auto number = [&](const LaneNumbers& numbers) { return at<V>(numbers, start_); };
    const SceneBlock::Inputs& inputs = block_.inputs[k];
    const V time = block_.has_hand ? number_ * number(block_.period) : number_ / number(block_.rate);
    Vector measured = at<V>(inputs.position, start_);
    if (block_.has_hand) {
      measured = encoded(tip_.x, number(block_.encoder_step), at<V>(block_.phase, start_));
      valid_ = valid_ && gate_.step(measured, time);
    }
    measured_ = measured;

    const Vector before = conditioned_, tip = condition(measured), axis = direction(tip, inputs.axis);
    conditioned_ = tip;
    if (block_.sub_steps > 1) step_between(select(number_ == 0, tip, before), axis);
    advance_proxies(tip, axis);
    model_force_ = {};
    for (const State& state : states_) model_force_ += state.f;
    valid_ = valid_ && model_force_.squaredNorm() <= 1e200;
    if (block_.has_hand) {
      // As the servo step fades: + 0 makes a zero of -0.
      Vector wanted = number(block_.force_scale) * model_force_ + Vector();
      if (!all(active_)) {
        Truth outside(true);
        for (const ContactTick<V>& tick : ticks_) outside = outside && tick.in_front;
        limiter_.reset(outside && !active_);
        active_ = active_ || outside;
        wanted = select(active_, wanted, Vector());
      }
      force_ = limiter_.step(wanted, V(0), time - time_);
      const BasicDeviceDynamics<V> device{V(0), V(0), V(0), number(block_.max_force)};
      const Vector tremor = tremor_.step(noise(k));
      tip_.step(block_.response.of_each(number), device.saturate(force_), at<V>(inputs.position, start_) + tremor,
                at<V>(inputs.velocity, start_));
    }
    time_ = time;
    number_ = number_ + V(1);
  }

  // The results of the last tick.
  const V& time() const noexcept { return time_; }                     ///< s
  const Vector& measured() const noexcept { return measured_; }        ///< the position that the device reported, m
  const Vector& tip() const noexcept { return conditioned_; }          ///< the conditioned position, m
  const Vector& model_force() const noexcept { return model_force_; }  ///< N
  const Vector& force() const noexcept { return force_; }              ///< of the device, N; 0 without a hand
  Truth limited() const noexcept { return limiter_.limit(); }          ///< a limit made the device's force smaller
  const ContactTick<V>& tick(std::size_t i) const noexcept { return ticks_[i]; }        ///< at membrane i
  const Vector& entry_direction(std::size_t i) const noexcept { return states_[i].b; }  ///< at membrane i
  std::size_t size() const noexcept { return ticks_.size(); }                           ///< the number of membranes
  /// The lanes that have come near a fault since they started. Their results are void.
  Truth invalid() const noexcept { return !valid_; }

 private:
  using Law = SpaceLaw<V>;
  using Limiter = BasicForceLimiter<V>;
  using Coupling = RelaxingCoupling<V>;
  using Params = SpaceParams<Law, Coupling>;
  using State = SpaceState<Law, Coupling>;

  static void restart(State& state, const Truth& lanes) noexcept {
    const State fresh;
    state.started = state.started && !lanes;
    state.phase = select(lanes, fresh.phase, state.phase);
    state.p = select(lanes, fresh.p, state.p);
    state.e = select(lanes, fresh.e, state.e);
    state.f = select(lanes, fresh.f, state.f);
    state.b = select(lanes, fresh.b, state.b);
    state.cos_beta = select(lanes, fresh.cos_beta, state.cos_beta);
    state.coupling = select(lanes, fresh.coupling, state.coupling);
  }

  /// The sub-steps of a tick without the last one, as ConditionedProxies makes them. before: of the last tick, m; in a
  /// first tick the tip, where a sub-step changes nothing.
  void step_between(const Vector& before, const Vector& axis) noexcept {
    for (std::uint32_t s = 1; s < block_.sub_steps; ++s) {
      const V share(static_cast<double>(s) / static_cast<double>(block_.sub_steps));
      advance_proxies(before + share * (conditioned_ - before), axis);
    }
  }

  Vector condition(const Vector& measured) noexcept {
    if (!block_.fits_lines) return low_pass_.step(measured);
    return alone(measured, [&](std::size_t lane, const Vector3d& p) { return block_.owner->fit(lane, p); });
  }
  Vector direction(const Vector& tip, const Vector3d& axis) noexcept {
    if (!block_.from_motion) return same<V>(axis);
    return alone(tip, [&](std::size_t lane, const Vector3d& p) { return block_.owner->direction(lane, p); });
  }
  /// each(lane, x) for one lane after the other. A lane without a trial has the result of the last one.
  template <typename Each>
  Vector alone(const Vector& x, Each&& each) noexcept {
    alignas(64) double numbers[3][V::lanes];
    for (std::size_t j = 0; j < 3; ++j) x[j].store(numbers[j]);
    Vector3d result;
    for (std::size_t i = 0; i < V::lanes; ++i) {
      if (start_ + i < block_.trials) result = each(start_ + i, {numbers[0][i], numbers[1][i], numbers[2][i]});
      for (std::size_t j = 0; j < 3; ++j) numbers[j][i] = result[j];
    }
    return {V::load(numbers[0]), V::load(numbers[1]), V::load(numbers[2])};
  }

  Coupling coupling() const noexcept {
    const CouplingBlock& c = block_.coupling;
    typename Coupling::Constants now{at<V>(c.K, start_), at<V>(c.g, start_), at<V>(c.inv_g, start_),
                                     at<V>(c.free_share, start_)};
    now.count = c.branches;
    for (std::size_t i = 0; i < now.count; ++i) now.branches[i] = {at<V>(c.a[i], start_), at<V>(c.k[i], start_)};
    return Coupling(now);
  }
  /// One step of all proxies, to this position (m).
  void advance_proxies(const Vector& position, const Vector& axis) noexcept {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const SpaceTick<V> t = Solver::step(params_[i], states_[i], position, axis);
      ticks_[i] = {t.depth, t.axial_force, t.band.lower, inside(t.phase), t.phase == Phase::outside};
    }
  }

  /// The noise of the tremor in tick k of the inputs.
  Vector noise(std::size_t k) const noexcept {
    alignas(64) double u[3][V::lanes];
    for (std::size_t i = 0; i < V::lanes; ++i) {  // compilers turn it into vectors
      const Vector3d now = tremor_noise(noise_[i], k);
      for (std::size_t j = 0; j < 3; ++j) u[j][i] = now[j];
    }
    return {V::load(u[0]), V::load(u[1]), V::load(u[2])};
  }

  SceneBlock& block_;
  std::size_t start_;
  V number_{0};  // of the next tick
  BasicTipMotion<V> tip_{};
  BasicTremor<V> tremor_{typename BasicTremor<V>::Filter{}};
  LowPass<V, Vector> low_pass_ = LowPass<V, Vector>::of_gain(Truth(true), V(0));
  Vector measured_{}, conditioned_{}, model_force_{}, force_{};
  Truth valid_{true}, active_{false};
  V time_{0};
  BasicInputGate<V> gate_;
  Limiter limiter_;
  std::vector<Params> params_;
  std::vector<State> states_;
  std::vector<ContactTick<V>> ticks_;
  TickNoise noise_[V::lanes];  // its number 0 is that of the tick of SceneBlock::inputs[0]
};

}  // namespace punctura::batch
