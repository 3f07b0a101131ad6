// The simulated plant: a haptic device in a hand.
#pragma once

#include <cmath>
#include <cstdint>

#include "punctura/plant/device_dynamics.hpp"
#include "punctura/plant/hand.hpp"

namespace punctura {

/// A haptic device in a hand, at its tip: m v' = f_device + k (x_d - x) + b (v_d - v) + dry friction, with m = device
/// + hand.
///
/// The force of the device saturates and is constant over the servo period, as with a digital-to-analogue converter.
/// The period is integrated in `substeps` semi-implicit Euler steps. Dry friction is implicit: in a step it stops the
/// mass or acts with its full force. So it does not chatter, and the mass does not creep.
template <typename Scalar>
class BasicPlant {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr int substeps = 16;

  BasicPlant(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand, Scalar period,
             std::uint64_t seed = 0) noexcept
      : device_(device), hand_(hand), h_(period / substeps), noise_(seed), tremor_(hand, period) {
    phase_ = noise_.uniform_vector().template cast<Scalar>();
  }

  /// Sets the position of the tip, m, at rest.
  void place(const Vector& position) noexcept {
    x_ = position;
    v_.setZero();
  }

  /// One servo period. force: constant force of the device, N. desired: the desired motion of the hand.
  void step(const Vector& force, const BasicDesired<Scalar>& desired) noexcept {
    const Vector held = device_.saturate(force);
    const Vector tremor = tremor_.step(noise_);
    const Scalar mass = device_.mass + hand_.mass;
    for (int i = 0; i < substeps; ++i) {
      const Vector wanted = desired.position + (static_cast<Scalar>(i) * h_) * desired.velocity + tremor;
      const Vector pull = hand_.stiffness * (wanted - x_) + hand_.damping * desired.velocity;
      // The damper of the hand is implicit as well, so that a firm grip on a light device stays stable.
      v_ = (v_ + h_ / mass * (held + pull)) / (1 + h_ * hand_.damping / mass);
      const Scalar speed = v_.norm(), lost = h_ * device_.friction / mass;
      v_ *= speed > lost ? 1 - lost / speed : Scalar(0);
      x_ += h_ * v_;
    }
  }

  const Vector& tip() const noexcept { return x_; }       ///< true position of the tip, m
  const Vector& velocity() const noexcept { return v_; }  ///< m/s

  /// The position that the encoders report, m: a multiple of encoder_step plus an offset that depends on the seed.
  Vector measured() const noexcept {
    if (device_.encoder_step == 0) return x_;
    Vector counts = x_ / device_.encoder_step + phase_;
    for (Scalar& count : counts) count = std::floor(count + Scalar(0.5));
    return (counts - phase_) * device_.encoder_step;
  }

  /// For save_state() and load_state() (state/archive.hpp).
  static void archive(auto& self, auto& state) {
    Noise::archive(self.noise_, state);
    BasicTremor<Scalar>::archive(self.tremor_, state);
    state.numbers(self.x_, self.v_);
  }
  void describe(auto& parameters) const {
    device_.describe(parameters);
    hand_.describe(parameters);
    noise_.describe(parameters);
    parameters.numbers(h_);
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
