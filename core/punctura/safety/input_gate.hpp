// What a sample must fulfil before the model sees it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "punctura/device/sample.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/safety/fault.hpp"

namespace punctura {

struct GateLimits {
  double max_speed = 8;          ///< m/s from one reading to the next: 5 mm at 1600 Hz
  double stale = 0.015;          ///< s without a new reading
  double deadline = 0.020;       ///< s from one tick to the next
  double axis_tolerance = 1e-3;  ///< of the axis' length from 1
  std::uint32_t dead_man = 0;    ///< buttons of which one must be held for force to be given; 0 asks for none
};

/// Judges one sample after the other. Each comparison is written so that NaN fails it. Times are double for each Scalar: a float
/// that counts seconds has no milliseconds after some hours.
template <typename Scalar>
class BasicInputGate {
 public:
  using Vector = Vector3<Scalar>;

  /// period: T, s.
  BasicInputGate(const GateLimits& limits, double period, bool axis_is_used) noexcept
      : limits_(limits), period_(period), axis_is_used_(axis_is_used) {}

  void reset() noexcept { started_ = false; }

  /// Goes on from where another gate is, with its own limits.
  void resume(const BasicInputGate& previous) noexcept {
    started_ = previous.started_;
    time_ = previous.time_;
    fresh_time_ = previous.fresh_time_;
    sequence_ = previous.sequence_;
    position_ = previous.position_;
  }

  /// Whether the hand allows force: no fault, but no force either while it does not.
  bool held(const DeviceSample& s) const noexcept {
    return limits_.dead_man == 0 || (s.buttons & limits_.dead_man) != 0;
  }

  Fault step(const DeviceSample& s) noexcept {
    if (!s.healthy) return Fault::device;
    const Vector position = to_vector(s.position).template cast<Scalar>(),
                 axis = to_vector(s.axis).template cast<Scalar>();
    if (!position.allFinite() || !std::isfinite(s.time)) return Fault::non_finite_input;
    if (axis_is_used_) {
      if (!axis.allFinite()) return Fault::non_finite_input;
      if (!(std::abs(axis.norm() - 1) <= static_cast<Scalar>(limits_.axis_tolerance))) return Fault::bad_axis;
    }
    if (started_) {
      if (!(s.time >= time_)) return Fault::clock;
      if (!(s.time - time_ <= limits_.deadline)) return Fault::missed_deadline;
      // Two readings that come close together may still be a period apart: T is the least time taken.
      const double since_reading = std::max(period_, s.time - fresh_time_);
      if (!((position - position_).norm() <= static_cast<Scalar>(limits_.max_speed * since_reading)))
        return Fault::position_jump;
    }
    if (!started_ || s.sequence != sequence_) fresh_time_ = s.time;
    if (!(s.time - fresh_time_ <= limits_.stale)) return Fault::stale_sample;

    started_ = true;
    time_ = s.time;
    position_ = position;
    sequence_ = s.sequence;
    return Fault::none;
  }

 private:
  GateLimits limits_;
  double period_;
  bool axis_is_used_;
  bool started_ = false;
  double time_ = 0, fresh_time_ = 0;
  std::uint64_t sequence_ = 0;
  Vector position_{};
};

using InputGate = BasicInputGate<double>;
using InputGateF = BasicInputGate<float>;

}  // namespace punctura
