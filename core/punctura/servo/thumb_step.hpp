// One tick of a second device, which holds the plunger of the syringe under the thumb.
#pragma once

#include <cmath>

#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"

namespace punctura {

/// The tick of the thumb's device: input gate, depth along a line, force limits.
///
/// The plunger itself runs in the servo step of the needle. This step measures the thumb for it, and gives the thumb
/// the force that the plunger had in the needle's last tick.
class ThumbStep {
 public:
  /// direction: in which the thumb pushes, of length 1. period: T of this device, s. Check gate and limits first.
  ThumbStep(const Vector3d& direction, double period, const GateLimits& gate = {},
            const ForceLimits& limits = {}) noexcept
      : direction_(direction), gate_(gate, period, false), limiter_(limits, period) {}

  /// Clears a fault. The thumb's next place is where the plunger starts.
  void reset() noexcept {
    gate_.state = {};
    fault_ = Fault::none;
    started_ = false;
    active_ = false;
  }

  /// One tick. plunger_force: on the thumb, N, negative while it pushes. active: whether the needle's device gets
  /// force. Returns the force for the device, N: zero if not active, in a fault, and without a dead-man button held.
  Vector3d step(const DeviceSample& sample, double plunger_force, bool active) noexcept {
    if (fault_ == Fault::none) fault_ = gate_.step(sample);
    if (fault_ == Fault::none && !std::isfinite(plunger_force)) fault_ = Fault::non_finite_force;
    const double elapsed = sample.time - time_;
    if (std::isfinite(sample.time)) time_ = sample.time;
    const bool gives = fault_ == Fault::none && active && gate_.held(sample);
    if (fault_ == Fault::none) {
      const double along = direction_.dot(to_vector(sample.position));
      if (!started_) home_ = along;
      started_ = true;
      depth_ = along - home_;
    }
    if (gives && !active_) limiter_.reset();  // the ramp begins
    active_ = gives;
    if (!gives) {
      limiter_.rest(sample.motor_temperature, elapsed);
      return Vector3d::Zero();
    }
    const Vector3d force = limiter_.step(plunger_force * direction_, sample.motor_temperature, elapsed);
    if (force.allFinite()) return force;
    fault_ = Fault::non_finite_force;  // impossible with limits that passed check(), as in ServoStepOf
    active_ = false;
    return Vector3d::Zero();
  }

  double depth() const noexcept { return depth_; }  ///< of the thumb, m
  Fault fault() const noexcept { return fault_; }
  bool active() const noexcept { return active_; }
  Limit limit() const noexcept { return limiter_.limit(); }

  double spent() const noexcept { return limiter_.budget().spent(); }
  /// As ServoStepOf::set_spent() and end().
  void set_spent(double spent) noexcept {
    limiter_.set_spent(spent);
    time_ = std::numeric_limits<double>::quiet_NaN();
  }
  void end(double elapsed) noexcept { limiter_.end(elapsed); }

 private:
  Vector3d direction_;
  InputGate gate_;
  ForceLimiter limiter_;
  Fault fault_ = Fault::none;
  bool started_ = false, active_ = false;
  double home_ = 0, depth_ = 0;
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace punctura
