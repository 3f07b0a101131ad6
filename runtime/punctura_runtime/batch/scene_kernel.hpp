// The ticks of trials of a scene, in lanes: conditioning, model and summary, and with a simulated hand also plant and
// force limits, as Experiment has them. It is compiled once for each instruction set.
//
// A fault never happens here. A lane that comes near one is marked as strange, and its trial is run again alone.
#pragma once

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include "punctura/plant/hand.hpp"
#include "punctura/plant/tip_motion.hpp"
#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"
#include "punctura/signal/low_pass.hpp"
#include "punctura_runtime/batch/isa.hpp"
#include "punctura_runtime/batch/present_pieces.hpp"
#include "punctura_runtime/batch/run_summary.hpp"
#include "punctura_runtime/batch/scene_block.hpp"
#include "punctura_runtime/batch/simd.hpp"
#include "punctura_runtime/batch/twice.hpp"

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
Vector3<V> same(const Vector3d& v) noexcept {
  return {V(v.x()), V(v.y()), V(v.z())};
}
template <typename V>
V size_of(const V& x) noexcept {
  return max(x, -x);
}
template <typename V>
V largest_of(const Vector3<V>& v) noexcept {
  return max(max(size_of(v.x()), size_of(v.y())), size_of(v.z()));
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

/// One vector of a block: its state.
template <typename V, typename Solver>
class SceneVector {
 public:
  using Vector = Vector3<V>;
  using Truth = typename V::Mask;

  SceneVector(SceneBlock& block, std::size_t start)
      : block_(block),
        start_(start),
        tip_{at<V>(block.place, start), {}},
        tremor_({at<V>(block.tremor_a1, start), at<V>(block.tremor_a2, start), at<V>(block.tremor_b, start)}),
        low_pass_(LowPass<V, Vector>::of_gain(!(at<V>(block.low_pass_is_off, start) == 0),
                                              at<V>(block.low_pass_gain, start))),
        states_(block.membranes.size()),
        ticks_(block.membranes.size()),
        summaries_(block.membranes.size()),
        summary_(at<V>(block.membranes[0].point, start), at<V>(block.membranes[0].normal, start), block.has_hand,
                 summaries_) {
    next_end_ = ends(0);
  }

  /// The ticks whose inputs are in the block.
  void run(std::size_t tick, std::size_t ticks) noexcept {
    for (std::size_t k = 0; k < ticks; ++k) {
      if (tick + k == next_end_) end(tick + k);
      step(tick + k, k);
    }
  }
  /// Reports the lanes that end before this tick.
  void finish(std::size_t tick) noexcept {
    if (tick == next_end_) end(tick);
  }

  /// For BasicRunSummary.
  BasicCrossing<V> enter(std::size_t i, const Truth& lanes, const Vector& b) noexcept {
    alignas(64) double from[3][V::lanes], to[7][V::lanes] = {};
    for (std::size_t j = 0; j < 3; ++j) b[j].store(from[j]);
    for_each(lanes, [&](std::size_t lane) {
      const Crossing c = block_.owner->enter(i, start_ + lane, {from[0][lane], from[1][lane], from[2][lane]}, axis_);
      const double numbers[] = {c.cos_beta, c.far_face, c.peak, c.through, c.again, c.shaft, c.settled};
      for (std::size_t j = 0; j < 7; ++j) to[j][lane] = numbers[j];
    });
    return {V::load(to[0]), V::load(to[1]), V::load(to[2]), V::load(to[3]),
            V::load(to[4]), V::load(to[5]), V::load(to[6])};
  }
  V through(std::size_t i, const Truth& lanes) noexcept {
    alignas(64) double depth[V::lanes] = {};
    for_each(lanes, [&](std::size_t lane) { depth[lane] = block_.owner->through(i, start_ + lane, axis_); });
    return V::load(depth);
  }

 private:
  using Law = SpaceLaw<V>;
  using Coupling = RelaxingCoupling<V>;
  using Params = SpaceParams<Law, Coupling>;

  void step(std::size_t tick, std::size_t k) noexcept {
    const auto number = [&](const LaneNumbers& numbers) { return at<V>(numbers, start_); };
    const SceneBlock::Inputs& inputs = block_.inputs[k];
    axis_ = inputs.told_axis;
    const V number_of_tick(static_cast<double>(tick));
    const V time = block_.has_hand ? number_of_tick * number(block_.period) : number_of_tick / number(block_.rate);
    Vector measured = at<V>(inputs.position, start_);
    if (block_.has_hand) {
      measured = encoded(tip_.x, number(block_.encoder_step), at<V>(block_.phase, start_));
      look(measured, tick > 0);
    }

    const Vector before = conditioned_, tip = condition(measured), axis = direction(tip, inputs.axis);
    conditioned_ = tip;
    const Coupling coupling = coupling_now();
    for (std::uint32_t s = 1; tick > 0 && s < block_.sub_steps; ++s) {  // as InsertionOf::step_between()
      const V share(static_cast<double>(s) / static_cast<double>(block_.sub_steps));
      advance_proxies(coupling, before + share * (tip - before), axis);
    }
    advance_proxies(coupling, tip, axis);
    Vector model_force;
    Truth outside(true);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      model_force += ticks_[i].force;
      outside = outside && ticks_[i].phase == Phase::outside;
    }
    strange_ = strange_ || !(largest_of(model_force) <= V(1e100));

    Truth limited(false);
    Vector force;
    if (block_.has_hand) {
      active_ = active_ || outside;
      force = limit(number(block_.force_scale) * model_force, tick > 0 ? time - time_ : V(0), limited);
      time_ = time;
    }

    summary_.add(
        {time, tip, same<V>(inputs.told_axis), model_force, force, limited}, *this,
        [&](std::size_t i) {
          const SpaceTick<V>& t = ticks_[i];
          return ContactTick<V>{t.depth, t.axial_force, t.band.lower, inside(t.phase), t.phase == Phase::outside};
        },
        [&](std::size_t i) { return ticks_[i].direction; });
    if (block_.keeps_force)
      for (std::size_t j = 0; j < 3; ++j) model_force[j].store(block_.force[k][j].of + start_);

    if (block_.has_hand) move(inputs, force);
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

  Coupling coupling_now() const noexcept {
    const CouplingBlock& c = block_.coupling;
    typename Coupling::Constants now{at<V>(c.K, start_), at<V>(c.g, start_), at<V>(c.inv_g, start_),
                                     at<V>(c.free_share, start_)};
    now.count = c.branches;
    for (std::size_t i = 0; i < now.count; ++i) now.branches[i] = {at<V>(c.a[i], start_), at<V>(c.k[i], start_)};
    return Coupling(now);
  }
  /// One step of all proxies, to this position (m).
  void advance_proxies(const Coupling& coupling, const Vector& position, const Vector& axis) noexcept {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const MembraneBlock& membrane = block_.membranes[i];
      const Params params{Law(block_, i, start_), at<V>(membrane.point, start_), at<V>(membrane.normal, start_),
                          coupling};
      ticks_[i] = Solver::step(params, states_[i], position, axis);
    }
  }

  /// Moves the plant for a period. force: of the device, N.
  void move(const SceneBlock::Inputs& inputs, const Vector& force) noexcept {
    const auto number = [&](const LaneNumbers& numbers) { return at<V>(numbers, start_); };
    const Vector u = at<V>(inputs.noise[0], start_), v = at<V>(inputs.noise[1], start_);
    const Vector normal(unit_normal(u.x(), v.x()), unit_normal(u.y(), v.y()), unit_normal(u.z(), v.z()));
    const BasicDeviceDynamics<V> device{number(block_.device_mass), number(block_.friction),
                                        number(block_.encoder_step), number(block_.max_force)};
    const BasicHand<V> hand{number(block_.mass), number(block_.damping), number(block_.stiffness), V(0), V(0)};
    tip_.step(device, hand, number(block_.h), force, {at<V>(inputs.position, start_), at<V>(inputs.velocity, start_)},
              tremor_.step(normal));
  }

  /// Marks a lane of which the input gate could report a fault.
  void look(const Vector& measured, bool started) noexcept {
    constexpr double margin = 0.99;  // of the gate's limit: rounding cannot make a lane pass that the gate would stop
    Truth good = largest_of(measured) <= V(margin * 1e6);
    if (started)
      good = good && (measured - measured_).norm() <= V(margin * GateLimits{}.max_speed) * at<V>(block_.period, start_);
    strange_ = strange_ || !good;
    measured_ = measured;
  }

  /// What BasicForceLimiter does with the default limits, for a device without a temperature.
  Vector limit(const Vector& wanted, const V& elapsed, Truth& limited) noexcept {
    budget_.spend(held_square_, elapsed);
    const V period = at<V>(block_.period, start_), ramp_step = period / V(limits.ramp_time);
    gain_ = select(active_, min(V(1), gain_ + ramp_step), gain_);
    const Vector faded = wanted + V(0) * Vector();
    const V most(limits.max_force), steady = min(most, sqrt(budget_.rate()));
    const V share = min(V(1), V(2) * budget_.left());
    const V hold = max(period, V(BasicForceLimiter<double>::longest_hold));
    const V ceiling = min(steady + share * (most - steady), sqrt(budget_.permitted_square(hold)));

    const V largest = largest_of(faded);
    const Vector ramped = gain_ * faded;
    const V largest_ramped = largest_of(ramped);
    const Truth is_zero = largest_ramped == 0;
    strange_ = strange_ || (active_ && !is_zero && !(largest_ramped >= V(1e-300)));
    const V norm = select(is_zero, V(0), largest_ramped * (ramped * (V(1) / largest_ramped)).norm());
    const Truth over = !(norm <= ceiling);
    const Vector force = select(active_, select(over, Vector(ramped / norm * ceiling), ramped), Vector());
    limited = active_ && (over || (gain_ < 1 && largest > 0));
    held_square_ = force.squaredNorm();
    return force;
  }

  /// The next tick in which a lane ends, from this tick on.
  std::size_t ends(std::size_t from) const noexcept {
    std::size_t next = ~std::size_t{0};
    for (std::size_t i = 0; i < V::lanes; ++i)
      if (const std::size_t t = block_.ticks[start_ + i]; t >= from) next = std::min(next, t);
    return next;
  }
  void end(std::size_t tick) noexcept {
    MembraneNumbers membranes[max_membranes];
    for (std::size_t lane = 0; lane < V::lanes; ++lane) {
      if (block_.ticks[start_ + lane] != tick || start_ + lane >= block_.trials) continue;
      const auto pick = [&](const V& x) {
        alignas(64) double numbers[V::lanes];
        x.store(numbers);
        return numbers[lane];
      };
      for (std::size_t i = 0; i < states_.size(); ++i) membranes[i] = summary_.membrane(i, pick);
      const double period = block_.period.of[start_ + lane];
      block_.owner->ended(start_ + lane, (strange_.bits() >> lane & 1u) != 0,
                          summary_.numbers(static_cast<double>(tick), period, pick), {membranes, states_.size()});
    }
    next_end_ = ends(tick + 1);
  }

  template <typename Each>
  static void for_each(const Truth& lanes, Each&& each) noexcept {
    for (unsigned bits = lanes.bits(); bits != 0; bits &= bits - 1)
      each(static_cast<std::size_t>(std::countr_zero(bits)));
  }

  static constexpr ForceLimits limits{};

  SceneBlock& block_;
  std::size_t start_, next_end_;
  BasicTipMotion<V> tip_;
  BasicTremor<V> tremor_;
  LowPass<V, Vector> low_pass_;
  Vector3d axis_{};  // of the sample
  Vector measured_{}, conditioned_{};
  Truth strange_{false}, active_{false};
  V time_{0}, gain_{0}, held_square_{0};
  BasicForceBudget<V> budget_{V(limits.continuous_time), V(limits.continuous_force)};
  std::vector<SpaceState<Law, Coupling>> states_;
  std::vector<SpaceTick<V>> ticks_;
  std::vector<MembraneSummary<V>> summaries_;
  BasicRunSummary<V> summary_;
};

template <typename Isa, typename Solver>
void run_scene(SceneBlock& block) {
  using V = Simd<WithPhases<Twice<Isa>>>;
  std::vector<std::unique_ptr<SceneVector<V, Solver>>> vectors;
  for (std::size_t start = 0; start < block.trials; start += V::lanes)
    vectors.push_back(std::make_unique<SceneVector<V, Solver>>(block, start));
  std::size_t last = 0;
  for (const std::size_t ticks : block.ticks) last = std::max(last, ticks);
  for (std::size_t tick = 0; tick < last && !block.owner->stopped(); tick += scene_ticks) {
    const std::size_t ticks = std::min(scene_ticks, last - tick);
    block.owner->prepare(tick, ticks);
    for (const auto& vector : vectors) vector->run(tick, ticks);
    if (block.keeps_force) block.owner->keep(tick, ticks);
  }
  for (const auto& vector : vectors) vector->finish(last);
}

}  // namespace punctura::batch
