// A haptic device in a hand: what the servo loop acts on when there is no hardware.
#pragma once

#include <cmath>
#include <cstdint>

#include "punctura/plant/device_dynamics.hpp"
#include "punctura/plant/hand.hpp"

namespace punctura {

/// m v' = f_device + k (x_d - x) + b (v_d - v) + dry friction, with m = device + hand. K06 section 4 without the hardware.
///
/// The device's force is held over the servo period, as a digital-to-analogue converter does, and saturates; the period is
/// integrated in `substeps` semi-implicit Euler steps. Dry friction is taken implicitly: it stops the mass within a step or
/// takes its full force from it, so it neither chatters nor creeps.
class Plant {
 public:
  static constexpr int substeps = 16;

  Plant(const DeviceDynamics& device, const Hand& hand, double period, std::uint64_t seed = 0) noexcept
      : device_(device), hand_(hand), h_(period / substeps), noise_(seed), tremor_(hand, period) {
    phase_ = Vector3d(noise_.uniform(), noise_.uniform(), noise_.uniform());
  }

  /// Puts the tip somewhere, at rest.
  void place(const Vector3d& position) noexcept {
    x_ = position;
    v_.setZero();
  }

  /// One servo period under a held force (N), with the hand on its way to `desired`.
  void step(const Vector3d& force, const Desired& desired) noexcept {
    const Vector3d held = device_.saturate(force);
    const Vector3d tremor = tremor_.step(noise_);
    const double mass = device_.mass + hand_.mass;
    for (int i = 0; i < substeps; ++i) {
      const Vector3d wanted = desired.position + (i * h_) * desired.velocity + tremor;
      const Vector3d pull = hand_.stiffness * (wanted - x_) + hand_.damping * desired.velocity;
      // The hand's damper is implicit too, so that a firm grip on a light device stays stable.
      v_ = (v_ + h_ / mass * (held + pull)) / (1 + h_ * hand_.damping / mass);
      const double speed = v_.norm(), lost = h_ * device_.friction / mass;
      v_ *= speed > lost ? 1 - lost / speed : 0.0;
      x_ += h_ * v_;
    }
  }

  const Vector3d& tip() const noexcept { return x_; }       ///< where the tip is, m
  const Vector3d& velocity() const noexcept { return v_; }  ///< m/s

  /// What the encoders say, m: a grid of encoder_step whose offset comes from the seed.
  Vector3d measured() const noexcept {
    if (device_.encoder_step == 0) return x_;
    Vector3d counts = x_ / device_.encoder_step + phase_;
    for (double& count : counts) count = std::floor(count + 0.5);
    return (counts - phase_) * device_.encoder_step;
  }

 private:
  DeviceDynamics device_;
  Hand hand_;
  double h_;
  Noise noise_;
  Tremor tremor_;
  Vector3d phase_, x_ = Vector3d::Zero(), v_ = Vector3d::Zero();
};

}  // namespace punctura
