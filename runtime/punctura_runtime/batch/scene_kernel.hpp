// Whole runs of trials of a scene, in lanes, with their summaries. It is compiled once for each instruction set.
#pragma once

#include <algorithm>
#include <bit>
#include <memory>

#include "punctura_runtime/batch/isa.hpp"
#include "punctura_runtime/batch/run_summary.hpp"
#include "punctura_runtime/batch/scene_lanes.hpp"

namespace punctura::batch {

/// One vector of a block: its lanes and their summaries.
template <typename V, typename Solver>
class SceneVector {
 public:
  using Vector = Vector3<V>;
  using Truth = typename V::Mask;

  SceneVector(SceneBlock& block, RunOwner& owner, std::size_t start)
      : block_(block),
        owner_(owner),
        start_(start),
        lanes_(block, start),
        summaries_(block.membranes.size()),
        summary_(at<V>(block.membranes[0].point, start), at<V>(block.membranes[0].normal, start), block.has_hand,
                 summaries_) {
    next_end_ = ends(0);
  }

  /// The ticks whose inputs are in the block.
  [[gnu::flatten]] void run(std::size_t tick, std::size_t ticks) noexcept {
    lanes_.prepare(ticks);
    for (std::size_t k = 0; k < ticks; ++k) {
      if (tick + k == next_end_) end(tick + k);
      step(k);
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
      const Crossing c = owner_.enter(i, start_ + lane, {from[0][lane], from[1][lane], from[2][lane]}, axis_);
      const double numbers[] = {c.cos_beta, c.far_face, c.peak, c.through, c.again, c.shaft, c.settled};
      for (std::size_t j = 0; j < 7; ++j) to[j][lane] = numbers[j];
    });
    return {V::load(to[0]), V::load(to[1]), V::load(to[2]), V::load(to[3]),
            V::load(to[4]), V::load(to[5]), V::load(to[6])};
  }
  V through(std::size_t i, const Truth& lanes) noexcept {
    alignas(64) double depth[V::lanes] = {};
    for_each(lanes, [&](std::size_t lane) { depth[lane] = owner_.through(i, start_ + lane, axis_); });
    return V::load(depth);
  }

 private:
  void step(std::size_t k) noexcept {
    axis_ = block_.inputs[k].sample_axis;
    lanes_.step(k);
    summary_.add(
        {lanes_.time(), lanes_.tip(), same<V>(axis_), lanes_.model_force(), lanes_.force(), lanes_.limited()}, *this,
        [&](std::size_t i) -> const ContactTick<V>& { return lanes_.tick(i); },
        [&](std::size_t i) { return lanes_.entry_direction(i); });
    if (block_.keeps_force) store(lanes_.model_force(), block_.force[k], start_);
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
      for (std::size_t i = 0; i < lanes_.size(); ++i) membranes[i] = summary_.membrane(i, pick);
      const double period = block_.period.of[start_ + lane];
      owner_.ended(start_ + lane, (lanes_.invalid().bits() >> lane & 1u) != 0,
                   summary_.numbers(static_cast<double>(tick), period, pick), {membranes, lanes_.size()});
    }
    next_end_ = ends(tick + 1);
  }

  template <typename Each>
  static void for_each(const Truth& lanes, Each&& each) noexcept {
    for (unsigned bits = lanes.bits(); bits != 0; bits &= bits - 1)
      each(static_cast<std::size_t>(std::countr_zero(bits)));
  }

  SceneBlock& block_;
  RunOwner& owner_;
  std::size_t start_, next_end_;
  Vector3d axis_{};  // of the sample
  SceneLanes<V, Solver> lanes_;
  std::vector<MembraneSummary<V>> summaries_;
  BasicRunSummary<V> summary_;
};

template <typename Isa, typename Solver>
void run_scene(SceneBlock& block, RunOwner& owner) {
  using V = Simd<WithPhases<Isa>>;
  std::vector<std::unique_ptr<SceneVector<V, Solver>>> vectors;
  for (std::size_t start = 0; start < block.trials; start += V::lanes)
    vectors.push_back(std::make_unique<SceneVector<V, Solver>>(block, owner, start));
  std::size_t last = 0;
  for (const std::size_t ticks : block.ticks) last = std::max(last, ticks);
  for (std::size_t tick = 0; tick < last && !owner.stopped(); tick += scene_ticks) {
    const std::size_t ticks = std::min(scene_ticks, last - tick);
    owner.prepare(tick, ticks);
    for (const auto& vector : vectors) vector->run(tick, ticks);
    if (block.keeps_force) owner.keep(tick, ticks);
  }
  for (const auto& vector : vectors) vector->finish(last);
}

}  // namespace punctura::batch
