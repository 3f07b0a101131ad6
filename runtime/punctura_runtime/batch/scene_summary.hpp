// The summary of one run of any scene.
#pragma once

#include <vector>

#include "punctura/scene/build.hpp"
#include "punctura_runtime/batch/run_summary.hpp"

namespace punctura::batch {

/// The depth (m) behind which a needle along the axis has passed a membrane.
template <ObliqueLaw L>
double through_along(const L& law, const Needle& needle, const PlacedMembrane& placed, const Vector3d& axis) noexcept {
  const Vector3d normal = to_vector(placed.inward_normal);
  const double cosine = std::abs(axis.dot(normal)) / normal.norm();
  return crossing(law, needle, placed.membrane.thickness, cosine).through;
}
/// The crossing of a needle that has entered a membrane in `direction`.
template <ObliqueLaw L>
Crossing crossing_along(const L& law, const Needle& needle, const PlacedMembrane& placed, const Vector3d& direction,
                        const Vector3d& axis) noexcept {
  const Vector3d normal = to_vector(placed.inward_normal).stableNormalized();
  return crossing(law, needle, placed.membrane.thickness, entry_cosine(normal, direction, axis));
}

class SceneSummary {
 public:
  /// scene must have passed check() and outlive the summary. device: whether the snapshots have the force of a device.
  SceneSummary(const Scene& scene, bool device)
      : scene_(scene),
        membranes_(scene.membranes.size()),
        summary_(to_vector(scene.membranes.front().point),
                 to_vector(scene.membranes.front().inward_normal).stableNormalized(), device, membranes_) {
    const auto law_of = scene_law_of<double>(scene);
    for (const PlacedMembrane& placed : scene.membranes)
      laws_.push_back(law_of(scene.needle, placed.membrane, laws_.size()));
  }
  SceneSummary(const SceneSummary&) = delete;

  void add(const Snapshot& s) noexcept {
    axis_ = to_vector(s.sample.axis);
    fault_ = s.fault;
    ++ticks_;
    summary_.add(
        {s.sample.time, to_vector(s.tip), axis_, to_vector(s.model_force), to_vector(s.force), s.limit != Limit::none},
        *this, [&](std::size_t i) { return contact_tick(s.membranes[i]); },
        [&](std::size_t i) { return to_vector(s.membranes[i].direction); });
  }

  RunNumbers numbers() const noexcept {
    RunNumbers n = summary_.numbers(static_cast<double>(ticks_), 1 / scene_.servo.rate, itself);
    n.fault = fault_;
    return n;
  }
  MembraneNumbers membrane(std::size_t i) const noexcept { return summary_.membrane(i, itself); }

  /// For BasicRunSummary.
  Crossing enter(std::size_t i, bool, const Vector3d& direction) const noexcept {
    return crossing_along(laws_[i], scene_.needle, scene_.membranes[i], direction, axis_);
  }
  double through(std::size_t i, bool) const noexcept {
    return through_along(laws_[i], scene_.needle, scene_.membranes[i], axis_);
  }

 private:
  static constexpr auto itself = [](double x) { return x; };

  const Scene& scene_;
  std::vector<SceneLaw<double>> laws_;
  std::vector<MembraneSummary<double>> membranes_;
  BasicRunSummary<double> summary_;
  Vector3d axis_{};
  Fault fault_ = Fault::none;
  std::uint64_t ticks_ = 0;
};

}  // namespace punctura::batch
