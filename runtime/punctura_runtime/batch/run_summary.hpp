// The numbers of a run, computed while it runs. They are those of punctura.compare.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "punctura/events/event_finder.hpp"

namespace punctura::batch {

/// The numbers of a run, SI. NaN where there is none.
struct RunNumbers {
  double peak = nothing;       ///< largest force of the model against the hand, N
  double felt_peak = nothing;  ///< largest force of the device against the hand, N; NaN without a device
  double depth = nothing;      ///< deepest place of the tip below the first surface, m
  double work = 0;             ///< of the hand against the model's force, first touch to the deepest place, J
  double dwell = 0;            ///< time in which the tip is inside a membrane, s
  double limited = 0;          ///< share of the ticks in which a limit made the device's force smaller
  Fault fault = Fault::none;   ///< that stopped the force
};

/// The numbers of a membrane in a run, SI. NaN without a pop.
struct MembraneNumbers {
  std::uint32_t pops = 0;
  double first_pop = nothing;  ///< time of the first pop, s
  double drop = nothing;       ///< largest drop of the model's resistance at a pop, N
  double overshoot = nothing;  ///< farthest the bevel ran on past the membrane after a pop, m
};

/// Follows a run, tick by tick. A tick allocates no memory.
class RunSummary {
 public:
  static constexpr double overshoot_time = 0.3;  ///< s after a pop in which the overshoot is measured, as in exercises

  /// scene must have passed check(). device: whether the snapshots have the force of a device.
  RunSummary(const Scene& scene, bool device)
      : finder_(scene), device_(device), period_(1 / scene.servo.rate), following_(scene.membranes.size()) {
    const PlacedMembrane& first = scene.membranes.front();
    point_ = to_vector(first.point);
    normal_ = to_vector(first.inward_normal).stableNormalized();
  }

  void add(const Snapshot& s) noexcept {
    const Vector3d tip = to_vector(s.tip), axis = to_vector(s.sample.axis);
    const double depth = (tip - point_).dot(normal_);
    numbers_.depth = std::fmax(numbers_.depth, depth);
    numbers_.peak = std::fmax(numbers_.peak, resistance(to_vector(s.model_force), axis));
    if (device_) numbers_.felt_peak = std::fmax(numbers_.felt_peak, resistance(to_vector(s.force), axis));
    numbers_.fault = s.fault;
    limited_ += s.limit != Limit::none;
    bool is_inside = false;
    for (std::size_t i = 0; i < following_.size(); ++i) is_inside = is_inside || inside(s.membranes[i].phase);
    inside_ += is_inside;

    const std::span<const Event> events = finder_.step(s);
    for (const Event& event : events)
      if (event.what == EventKind::touch && touched_ == none) touched_ = event.membrane;
    if (touched_ != none && !left_) {
      work_ -= to_vector(s.model_force).dot(axis) * (ticks_ > 0 ? (tip - last_tip_).dot(axis) : 0.0);
      if (!(depth <= deepest_)) {
        deepest_ = depth;
        numbers_.work = work_;
      }
    }
    for (const Event& event : events) {
      if (event.what == EventKind::out && event.membrane == touched_) left_ = true;
      if (event.what == EventKind::pop) following_[event.membrane].pop(event, axis, finder_.scene());
    }
    for (std::size_t i = 0; i < following_.size(); ++i) following_[i].follow(s.sample.time, s.membranes[i].depth);
    last_tip_ = tip;
    ++ticks_;
  }

  RunNumbers numbers() const noexcept {
    RunNumbers n = numbers_;
    n.dwell = static_cast<double>(inside_) * period_;
    n.limited = ticks_ == 0 ? 0 : static_cast<double>(limited_) / static_cast<double>(ticks_);
    return n;
  }
  const MembraneNumbers& membrane(std::size_t i) const noexcept { return following_[i].numbers; }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// The size of a force on the hand, N; negative if it pulls the needle in.
  static double resistance(const Vector3d& force, const Vector3d& axis) noexcept {
    return force.dot(axis) > 0 ? -force.norm() : force.norm();
  }

  /// A membrane, and how far the needle runs on after a pop.
  struct Following {
    MembraneNumbers numbers{};
    double through = 0, until = -std::numeric_limits<double>::infinity();  // m, s

    void pop(const Event& event, const Vector3d& axis, const Scene& scene) noexcept {
      if (++numbers.pops == 1) numbers.first_pop = event.time;
      numbers.drop = std::fmax(numbers.drop, event.drop());
      numbers.overshoot = std::fmax(numbers.overshoot, 0.0);
      const PlacedMembrane& placed = scene.membranes[event.membrane];
      const Vector3d normal = to_vector(placed.inward_normal);
      const TissueLaw law(scene.needle, placed.membrane, placed.tissue);
      const double cosine = std::abs(axis.dot(normal)) / normal.norm();
      through = crossing(law, scene.needle, placed.membrane.thickness, cosine).through;
      until = event.time + overshoot_time;
    }
    void follow(double time, double depth) noexcept {
      if (time <= until) numbers.overshoot = std::fmax(numbers.overshoot, depth - through);
    }
  };

  EventFinder finder_;
  bool device_;
  double period_;
  Vector3d point_, normal_;
  std::vector<Following> following_;
  RunNumbers numbers_{};
  std::uint64_t ticks_ = 0, inside_ = 0, limited_ = 0;
  std::uint32_t touched_ = none;  // number of the membrane that was touched first
  bool left_ = false;
  double work_ = 0, deepest_ = -std::numeric_limits<double>::infinity();
  Vector3d last_tip_;
};

}  // namespace punctura::batch
