// Trials of a fleet, in lanes. It is compiled once for each instruction set.
#pragma once

#include <limits>
#include <memory>
#include <utility>

#include "punctura_runtime/batch/isa.hpp"
#include "punctura_runtime/batch/scene_block.hpp"
#include "punctura_runtime/batch/scene_lanes.hpp"

namespace punctura::batch {

/// The lanes of a block, with the record of each.
template <typename V, typename Solver>
class FleetVectors final : public FleetLanes {
 public:
  explicit FleetVectors(SceneBlock& block) : FleetLanes(block.membranes.size()), block_(block) {
    for (std::size_t start = 0; start < block.width; start += V::lanes) vectors_.emplace_back(block, start);
    begin();
  }

  void restart(std::size_t from, std::size_t to) noexcept override {
    alignas(64) double chosen[block_lanes] = {};
    for (std::size_t lane = from; lane < to; ++lane) chosen[lane] = 1;
    for (std::size_t i = 0; i < vectors_.size(); ++i) vectors_[i].restart(V::load(chosen + i * V::lanes) == V(1));
    for (std::size_t lane = from; lane < to; ++lane) record_.travel.of[lane] = 0;
  }

  void begin() noexcept override {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto fill = [](LaneNumbers& numbers, double x) { std::fill(numbers.of, numbers.of + block_lanes, x); };
    fill(record_.lowest_force, infinity);
    fill(record_.highest_force, -infinity);
    for (LaneNumbers& deepest : record_.deepest) fill(deepest, -infinity);
  }

  void step(std::size_t ticks) noexcept override {
    record_.invalid = 0;
    for (std::size_t i = 0; i * V::lanes < block_.trials; ++i) advance(vectors_[i], i * V::lanes, ticks);
  }

 private:
  using Lanes = SceneLanes<V, Solver>;

  void advance(Lanes& lanes, std::size_t start, std::size_t ticks) noexcept {
    V force, lowest = at<V>(record_.lowest_force, start), highest = at<V>(record_.highest_force, start);
    lanes.prepare(ticks);
    for (std::size_t k = 0; k < ticks; ++k) {
      lanes.step(k);
      force = -same<V>(block_.inputs[k].sample_axis).dot(lanes.force());
      lowest = min(lowest, force);
      highest = max(highest, force);
      for (std::size_t i = 0; i < lanes.size(); ++i)
        max(at<V>(record_.deepest[i], start), lanes.tick(i).depth).store(record_.deepest[i].of + start);
    }
    force.store(record_.force.of + start);
    lowest.store(record_.lowest_force.of + start);
    highest.store(record_.highest_force.of + start);
    same<V>(block_.inputs[0].sample_axis)
        .dot(lanes.measured() - at<V>(block_.place, start))
        .store(record_.travel.of + start);
    for (std::size_t i = 0; i < lanes.size(); ++i) lanes.tick(i).depth.store(record_.depth[i].of + start);
    record_.invalid |= static_cast<std::uint64_t>(lanes.invalid().bits()) << start;
  }

  SceneBlock& block_;
  std::vector<Lanes> vectors_;
};

template <typename Isa, typename Solver>
std::unique_ptr<FleetLanes> make_fleet(SceneBlock& block) {
  return std::make_unique<FleetVectors<Simd<WithPhases<Isa>>, Solver>>(block);
}

}  // namespace punctura::batch
