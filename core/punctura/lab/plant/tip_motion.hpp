// The motion of the mass that device and hand form at the tip. Scalar: a number, or lanes (model/lane.hpp).
#pragma once

#include "punctura/lab/plant/device_dynamics.hpp"
#include "punctura/lab/plant/hand_dynamics.hpp"

namespace punctura {

/// The position and velocity of the tip: m v' = f_device + k (x_d - x) + b (v_d - v) + dry friction, with m = device
/// + hand.
///
/// The force of the device saturates and is constant over the servo period, as with a digital-to-analogue converter.
/// The period is integrated in `substeps` semi-implicit Euler steps. Dry friction is implicit: in a step it stops the
/// mass or acts with its full force. So it does not chatter, and the mass does not creep.
template <typename Scalar>
struct BasicTipMotion {
  using Vector = Vector3<Scalar>;
  static constexpr int substeps = 16;

  Vector x{}, v{};  ///< m, m/s

  /// One servo period. h: s, the period / substeps. force: constant force of the device, N. desired: the desired motion
  /// of the hand. tremor: m.
  void step(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand, const Scalar& h,
            const Vector& force, const BasicDesired<Scalar>& desired, const Vector& tremor) noexcept {
    using namespace lane;
    const Vector held = device.saturate(force);
    const Scalar mass = device.mass + hand.mass;
    const Scalar per_force = h / mass, damped = 1 / (1 + h * hand.damping / mass), lost = h * device.friction / mass;
    const Scalar stiffness = hand.stiffness;
    const Vector damper = hand.damping * desired.velocity;
    for (int i = 0; i < substeps; ++i) {
      const Vector wanted = desired.position + (static_cast<Lane<Scalar>>(i) * h) * desired.velocity + tremor;
      const Vector pull = stiffness * (wanted - x) + damper;
      // The damper of the hand is implicit as well, so that a firm grip on a light device stays stable.
      v = (v + per_force * (held + pull)) * damped;
      const Scalar speed = v.norm();
      v *= select(speed > lost, Scalar(1 - lost / speed), Scalar(0));
      x += h * v;
    }
  }
};

/// The position that encoders report for x, m: a multiple of encoder_step plus an offset. phase: the offset, in steps.
template <typename Scalar>
Vector3<Scalar> encoded(const Vector3<Scalar>& x, const Scalar& encoder_step, const Vector3<Scalar>& phase) noexcept {
  using namespace lane;
  Vector3<Scalar> counts = x / encoder_step + phase;
  for (Scalar& count : counts) count = floor(count + Lane<Scalar>(0.5));
  return select(encoder_step == 0, x, Vector3<Scalar>((counts - phase) * encoder_step));
}

}  // namespace punctura
