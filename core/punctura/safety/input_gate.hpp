// The checks of a sample before the model uses it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "punctura/device/sample.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/safety/fault.hpp"

namespace punctura {

/// What a reading must fulfil, and when it must come. Beyond it the run has a fault.
struct GateLimits {
  double max_speed = 8;          ///< m/s from one reading to the next; at 1600 Hz this is 5 mm
  double stale = 0.015;          ///< longest time without a new reading, s
  double deadline = 0.020;       ///< longest time from one tick to the next, s
  double axis_tolerance = 1e-3;  ///< largest difference of the axis' length from 1
  std::uint32_t dead_man = 0;    ///< bits of the dead-man buttons: force needs one of them held; 0 needs none
};

/// Checks each sample. Each comparison is written so that NaN fails the check.
///
/// Times are double also for float, because a float in seconds cannot resolve milliseconds after some hours.
template <typename Scalar>
class BasicInputGate {
 public:
  using Vector = Vector3<Scalar>;
  using Time = std::conditional_t<OneNumber<Scalar>, double, Scalar>;

  /// What it remembers of the last sample. A gate with the state of another one goes on, with its own limits.
  struct State {
    Mask<Scalar> started{};
    Time time{}, fresh_time{};
    std::uint64_t sequence = 0;
    Vector position{};
  };
  State state{};

  /// period: T, s.
  constexpr BasicInputGate(const GateLimits& limits, const Time& period, bool axis_is_used) noexcept
      : limits_(limits), period_(period), axis_is_used_(axis_is_used) {}

  /// Whether a dead-man button is held, or none is needed. If not, there is no force, but this is no fault.
  constexpr bool held(const DeviceSample& s) const noexcept {
    return limits_.dead_man == 0 || (s.buttons & limits_.dead_man) != 0;
  }

  /// Checks a sample. Returns its fault, or Fault::none.
  constexpr Fault step(const DeviceSample& s) noexcept {
    if (!s.healthy) return Fault::device;
    const Vector position = to_vector(s.position).template cast<Scalar>(),
                 axis = to_vector(s.axis).template cast<Scalar>();
    if (!is_place(position) || !lane::finite(s.time + s.motor_temperature + s.thumb_felt))
      return Fault::non_finite_input;
    if (!is_place(s.thumb)) return s.thumb == s.thumb ? Fault::non_finite_input : Fault::thumb;
    if (axis_is_used_) {
      if (!axis.allFinite()) return Fault::non_finite_input;
      if (!(lane::abs(axis.norm() - 1) <= static_cast<Scalar>(limits_.axis_tolerance))) return Fault::bad_axis;
    }
    if (state.started) {
      if (!(s.time >= state.time)) return Fault::clock;
      if (!in_time(s.time)) return Fault::missed_deadline;
      if (!within_reach(position, s.time - state.fresh_time)) return Fault::position_jump;
    }
    if (!state.started || s.sequence != state.sequence) state.fresh_time = s.time;
    if (!(s.time - state.fresh_time <= limits_.stale)) return Fault::stale_sample;

    state = {true, s.time, state.fresh_time, s.sequence, position};
    return Fault::none;
  }

  /// Checks a sample in each lane: a new reading, later than the last. Returns the lanes without a fault.
  constexpr Mask<Scalar> step(const Vector& position, const Time& time) noexcept
    requires Lanes<Scalar>
  {
    const auto good =
        is_place(position) && (!state.started || (in_time(time) && within_reach(position, time - state.time)));
    state.started = Mask<Scalar>(true);
    state.time = time;
    state.position = position;
    return good;
  }
  /// The next sample of these lanes is their first.
  constexpr void restart(const Mask<Scalar>& lanes) noexcept { state.started = state.started && !lanes; }

  static void archive(auto& self, auto& state) {
    auto& own = self.state;
    state.fields(own.started, own.time, own.fresh_time, own.position, own.sequence);
  }
  void describe(auto& parameters) const {
    const GateLimits& l = limits_;
    parameters.fields(l.max_speed, l.stale, l.deadline, l.axis_tolerance, period_, l.dead_man, axis_is_used_);
  }

 private:
  constexpr Mask<Scalar> in_time(const Time& time) const noexcept { return time - state.time <= limits_.deadline; }
  /// Whether a hand can have come here since the last reading, `elapsed` s ago. Two readings that arrive close together
  /// can be a period apart. Therefore the time is at least T.
  constexpr Mask<Scalar> within_reach(const Vector& position, const Time& elapsed) const noexcept {
    using namespace lane;
    const auto farthest = static_cast<Scalar>(limits_.max_speed * max(period_, elapsed));
    return (position - state.position).squaredNorm() <= farthest * farthest;
  }

  GateLimits limits_;
  Time period_;
  bool axis_is_used_;
};

using InputGate = BasicInputGate<double>;
using InputGateF = BasicInputGate<float>;

}  // namespace punctura
