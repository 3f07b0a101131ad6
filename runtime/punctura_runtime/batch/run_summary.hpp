// The numbers of a run, computed while it runs. They are those of punctura.compare. Scalar: a number, or lanes.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "punctura/lab/events/contact.hpp"
#include "punctura/scene/build.hpp"

namespace punctura::batch {

/// The numbers of a run, SI. NaN where there is none.
struct RunNumbers {
  double peak = not_given;       ///< largest force of the model against the hand, N
  double felt_peak = not_given;  ///< largest force of the device against the hand, N; NaN without a device
  double depth = not_given;      ///< deepest place of the tip below the first surface, m
  double work = 0;               ///< of the hand against the model's force, first touch to the deepest place, J
  double dwell = 0;              ///< time in which the tip is inside a membrane, s
  double limited = 0;            ///< share of the ticks in which a limit made the device's force smaller
  Fault fault = Fault::none;     ///< that stopped the force
  bool in_lanes = false;         ///< computed in SIMD lanes; otherwise one number at a time
};

/// The numbers of a membrane in a run, SI. NaN without a pop.
struct MembraneNumbers {
  std::uint32_t pops = 0;
  double first_pop = not_given;  ///< time of the first pop, s
  double drop = not_given;       ///< largest drop of the model's resistance at a pop, N
  double overshoot = not_given;  ///< farthest the bevel ran on past the membrane after a pop, m
};

/// What a summary reads of a tick.
template <typename Scalar>
struct RunTick {
  Scalar time;                  ///< s
  Vector3<Scalar> tip, axis;    ///< m; unit direction of the needle
  Vector3<Scalar> model_force;  ///< N
  Vector3<Scalar> force;        ///< of the device, N
  Mask<Scalar> limited;         ///< a limit made the device's force smaller
};

/// What a summary keeps of a membrane: BasicRunSummary::Following.
template <typename Scalar>
struct MembraneSummary {
  BasicContact<Scalar> contact{};
  Scalar pops{0}, first_pop{not_given}, drop{not_given}, overshoot{not_given};
  Scalar through{0}, until{-std::numeric_limits<double>::infinity()};  // m, s
};

/// Follows a run, tick by tick. A tick allocates no memory.
///
/// Laws: has enter(i, lanes, direction), the Crossing of membrane i for a needle that enters in this direction, and
/// through(i, lanes), the depth (m) behind which a needle along the axis has passed membrane i.
template <typename Scalar>
class BasicRunSummary {
 public:
  using Vector = Vector3<Scalar>;
  using Truth = Mask<Scalar>;
  static constexpr double overshoot_time = 0.3;  ///< s after a pop in which the overshoot is measured, as in exercises

  /// point, normal: any point of the first surface, m, and its inward normal of length 1. device: whether the ticks
  /// have the force of a device. membranes: one for each membrane.
  BasicRunSummary(const Vector& point, const Vector& normal, bool device,
                  std::span<MembraneSummary<Scalar>> membranes) noexcept
      : membranes_(membranes), device_(device), point_(point), normal_(normal) {}

  /// now(i): the ContactTick of membrane i. direction(i): b.
  template <typename Laws, typename Now, typename Direction>
  void add(const RunTick<Scalar>& t, Laws&& laws, Now&& now, Direction&& direction) noexcept {
    using namespace lane;
    const Scalar depth = (t.tip - point_).dot(normal_);
    depth_ = max(depth_, depth);
    peak_ = max(peak_, resistance(t.model_force, t.axis));
    if (device_) felt_peak_ = max(felt_peak_, resistance(t.force, t.axis));
    if (any(t.limited)) limited_ = limited_ + select(t.limited, Scalar(1), Scalar(0));

    Truth is_inside(false), leaves(false);
    for (std::size_t i = 0; i < membranes_.size(); ++i) {
      MembraneSummary<Scalar>& membrane = membranes_[i];
      const ContactTick<Scalar>& tick = now(i);
      is_inside = is_inside || tick.acts;
      const Scalar number(static_cast<double>(i));
      membrane.contact.step(
          tick, [&](const Truth& lanes) { return laws.enter(i, lanes, direction(i)); },
          [&](EventKind what, const Truth& lanes, const Scalar& before, const Scalar& after) {
            if (what == EventKind::touch) touched_ = select(lanes && touched_ < 0, number, touched_);
            if (what == EventKind::out) leaves = leaves || (lanes && touched_ == number);
            if (what == EventKind::pop) pop(membrane, t.time, lanes, before - after, laws.through(i, lanes));
          });
    }
    inside_ = inside_ + select(is_inside, Scalar(1), Scalar(0));

    if (const Truth works = touched_ >= 0 && !left_; any(works)) {
      const Scalar way = started_ ? (t.tip - last_tip_).dot(t.axis) : Scalar(0);
      now_work_ = select(works, Scalar(now_work_ - t.model_force.dot(t.axis) * way), now_work_);
      const Truth deepest = works && !(depth <= deepest_);
      deepest_ = select(deepest, depth, deepest_);
      work_ = select(deepest, now_work_, work_);
      left_ = left_ || leaves;
    }

    for (std::size_t i = 0; i < membranes_.size(); ++i) {
      MembraneSummary<Scalar>& membrane = membranes_[i];
      const Truth follows = t.time <= membrane.until;
      if (any(follows))
        membrane.overshoot =
            select(follows, larger(membrane.overshoot, now(i).depth - membrane.through), membrane.overshoot);
    }
    last_tip_ = t.tip;
    started_ = true;
  }

  /// The numbers after some ticks with this period (s), without the fault. pick(x): the number of a lane.
  template <typename Pick>
  RunNumbers numbers(double ticks, double period, Pick&& pick) const noexcept {
    RunNumbers n;
    const auto found = [&](const Scalar& most) { return pick(most) == -infinity ? not_given : pick(most); };
    const auto root = [](double square) { return std::copysign(std::sqrt(std::abs(square)), square); };
    n.peak = root(found(peak_));
    n.felt_peak = root(found(felt_peak_));
    n.depth = found(depth_);
    n.work = pick(work_);
    n.dwell = pick(inside_) * period;
    n.limited = ticks == 0 ? 0 : pick(limited_) / ticks;
    return n;
  }
  template <typename Pick>
  MembraneNumbers membrane(std::size_t i, Pick&& pick) const noexcept {
    const MembraneSummary<Scalar>& m = membranes_[i];
    return {static_cast<std::uint32_t>(pick(m.pops)), pick(m.first_pop), pick(m.drop), pick(m.overshoot)};
  }

 private:
  /// The larger one, or the one that is a number.
  static Scalar larger(const Scalar& a, const Scalar& b) noexcept {
    using namespace lane;
    return select(b > a || !(a == a), b, a);
  }
  /// The square of the size of a force on the hand, N^2; negative if the force pulls the needle in. Its root comes at
  /// the end: the root of the largest is the largest root.
  static Scalar resistance(const Vector& force, const Vector& axis) noexcept {
    using namespace lane;
    const Scalar square = force.squaredNorm();
    return select(force.dot(axis) > 0, Scalar(-square), square);
  }
  static void pop(MembraneSummary<Scalar>& m, const Scalar& time, const Truth& lanes, const Scalar& drop,
                  const Scalar& through) noexcept {
    using namespace lane;
    m.first_pop = select(lanes && m.pops == 0, time, m.first_pop);
    m.pops = m.pops + select(lanes, Scalar(1), Scalar(0));
    m.drop = select(lanes, larger(m.drop, drop), m.drop);
    m.overshoot = select(lanes, larger(m.overshoot, Scalar(0)), m.overshoot);
    m.through = select(lanes, through, m.through);
    m.until = select(lanes, Scalar(time + overshoot_time), m.until);
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  std::span<MembraneSummary<Scalar>> membranes_;
  bool device_, started_ = false;
  Vector point_, normal_;
  // peak_, felt_peak_: see resistance(). max() skips what is no number.
  Scalar peak_{-infinity}, felt_peak_{-infinity}, depth_{-infinity}, work_{0};
  Scalar inside_{0}, limited_{0};  // ticks
  Scalar touched_{-1};             // number of the membrane that was touched first; -1: none
  Truth left_{false};
  Scalar now_work_{0}, deepest_{-infinity};
  Vector last_tip_{};
};

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
