// The checks of a sample before the model uses it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "punctura/device/sample.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/safety/fault.hpp"

namespace punctura {

/// The limits of the input gate.
struct GateLimits {
  double max_speed = 8;          ///< m/s from one reading to the next; at 1600 Hz this is 5 mm
  double stale = 0.015;          ///< longest time without a new reading, s
  double deadline = 0.020;       ///< longest time from one tick to the next, s
  double axis_tolerance = 1e-3;  ///< largest difference of the axis' length from 1
  std::uint32_t dead_man = 0;    ///< bits of the dead-man buttons: force needs one of them held; 0 needs none
};

/// Checks each sample. Each comparison is written so that NaN fails the check.
///
/// Times are double for every Scalar, because a float in seconds cannot resolve milliseconds after some hours.
template <typename Scalar>
class BasicInputGate {
 public:
  using Vector = Vector3<Scalar>;

  /// period: T, s.
  BasicInputGate(const GateLimits& limits, double period, bool axis_is_used) noexcept
      : limits_(limits), period_(period), axis_is_used_(axis_is_used) {}

  void reset() noexcept { started_ = false; }

  /// Takes over the state of another gate, but keeps its own limits.
  void resume(const BasicInputGate& previous) noexcept {
    started_ = previous.started_;
    time_ = previous.time_;
    fresh_time_ = previous.fresh_time_;
    sequence_ = previous.sequence_;
    position_ = previous.position_;
  }

  /// Whether a dead-man button is held, or none is needed. If not, there is no force, but this is no fault.
  bool held(const DeviceSample& s) const noexcept {
    return limits_.dead_man == 0 || (s.buttons & limits_.dead_man) != 0;
  }

  /// Checks a sample. Returns its fault, or Fault::none.
  Fault step(const DeviceSample& s) noexcept {
    if (!s.healthy) return Fault::device;
    const Vector position = to_vector(s.position).template cast<Scalar>(),
                 axis = to_vector(s.axis).template cast<Scalar>();
    if (!is_place(position) || !std::isfinite(s.time + s.motor_temperature + s.thumb_felt))
      return Fault::non_finite_input;
    if (!is_place(s.thumb)) return std::isnan(s.thumb) ? Fault::thumb : Fault::non_finite_input;
    if (axis_is_used_) {
      if (!axis.allFinite()) return Fault::non_finite_input;
      if (!(std::abs(axis.norm() - 1) <= static_cast<Scalar>(limits_.axis_tolerance))) return Fault::bad_axis;
    }
    if (started_) {
      if (!(s.time >= time_)) return Fault::clock;
      if (!(s.time - time_ <= limits_.deadline)) return Fault::missed_deadline;
      // Two readings that arrive close together can be a period apart. Therefore the time is at least T.
      const double since_reading = std::max(period_, s.time - fresh_time_);
      const auto farthest = static_cast<Scalar>(limits_.max_speed * since_reading);
      if (!((position - position_).squaredNorm() <= farthest * farthest)) return Fault::position_jump;
    }
    if (!started_ || s.sequence != sequence_) fresh_time_ = s.time;
    if (!(s.time - fresh_time_ <= limits_.stale)) return Fault::stale_sample;

    started_ = true;
    time_ = s.time;
    position_ = position;
    sequence_ = s.sequence;
    return Fault::none;
  }

  static void archive(auto& self, auto& state) {
    state.flag(self.started_);
    state.numbers(self.time_, self.fresh_time_, self.position_);
    state.index(self.sequence_, std::numeric_limits<std::uint64_t>::max());
  }
  void describe(auto& parameters) const {
    parameters.numbers(limits_.max_speed, limits_.stale, limits_.deadline, limits_.axis_tolerance, period_);
    parameters.index(limits_.dead_man, 0);
    parameters.flag(axis_is_used_);
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
