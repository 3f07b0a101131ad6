// The motion of the tip by many small steps, to compare BasicTipMotion with: another method, and slow.
#pragma once

#include "punctura/lab/plant/hand.hpp"

namespace punctura::test {

/// Semi-implicit Euler steps with implicit friction: each step stops the mass or has the full friction. Its error is
/// proportional to the step.
struct SubSteppedTip {
  Vector3d x{}, v{};  ///< m, m/s

  /// One period (s). held: force of the device, N.
  void step(const DeviceDynamics& device, const Hand& hand, double period, int steps, const Vector3d& held,
            const Desired& desired) {
    const double mass = device.mass + hand.mass, h = period / steps;
    for (int i = 0; i < steps; ++i) {
      const Vector3d wanted = desired.position + (i * h) * desired.velocity;
      const Vector3d pull = held + hand.stiffness * (wanted - x) + hand.damping * desired.velocity;
      v = (v + h / mass * pull) / (1 + h * hand.damping / mass);
      const double speed = v.norm(), lost = h * device.friction / mass;
      v *= speed > lost ? 1 - lost / speed : 0;
      x += h * v;
    }
  }
};

}  // namespace punctura::test
