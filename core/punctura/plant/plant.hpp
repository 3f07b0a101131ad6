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
template <typename Scalar>
class BasicPlant {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr int substeps = 16;

  BasicPlant(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand, Scalar period,
             std::uint64_t seed = 0) noexcept
      : device_(device), hand_(hand), h_(period / substeps), noise_(seed), tremor_(hand, period) {
    phase_ = Vector3d{noise_.uniform(), noise_.uniform(), noise_.uniform()}.template cast<Scalar>();
  }

  /// Puts the tip somewhere, at rest.
  void place(const Vector& position) noexcept {
    x_ = position;
    v_.setZero();
  }

  /// One servo period under a held force (N), with the hand on its way to `desired`.
  void step(const Vector& force, const BasicDesired<Scalar>& desired) noexcept {
    const Vector held = device_.saturate(force);
    const Vector tremor = tremor_.step(noise_);
    const Scalar mass = device_.mass + hand_.mass;
    for (int i = 0; i < substeps; ++i) {
      const Vector wanted = desired.position + (static_cast<Scalar>(i) * h_) * desired.velocity + tremor;
      const Vector pull = hand_.stiffness * (wanted - x_) + hand_.damping * desired.velocity;
      // The hand's damper is implicit too, so that a firm grip on a light device stays stable.
      v_ = (v_ + h_ / mass * (held + pull)) / (1 + h_ * hand_.damping / mass);
      const Scalar speed = v_.norm(), lost = h_ * device_.friction / mass;
      v_ *= speed > lost ? 1 - lost / speed : Scalar(0);
      x_ += h_ * v_;
    }
  }

  const Vector& tip() const noexcept { return x_; }       ///< where the tip is, m
  const Vector& velocity() const noexcept { return v_; }  ///< m/s

  /// What the encoders say, m: a grid of encoder_step whose offset comes from the seed.
  Vector measured() const noexcept {
    if (device_.encoder_step == 0) return x_;
    Vector counts = x_ / device_.encoder_step + phase_;
    for (Scalar& count : counts) count = std::floor(count + Scalar(0.5));
    return (counts - phase_) * device_.encoder_step;
  }

 private:
  BasicDeviceDynamics<Scalar> device_;
  BasicHand<Scalar> hand_;
  Scalar h_;
  Noise noise_;
  BasicTremor<Scalar> tremor_;
  Vector phase_, x_ = Vector::Zero(), v_ = Vector::Zero();
};

using Plant = BasicPlant<double>;
using PlantF = BasicPlant<float>;

}  // namespace punctura
