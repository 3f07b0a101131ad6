// The mechanics of an impedance-type haptic device at the tip.
#pragma once

#include "punctura/model/omni.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// The mechanics of a device at the tip. The defaults are those of a PHANTOM Omni.
///
/// The values are constant. On a real device they change over the workspace and with the direction.
template <typename Scalar>
struct BasicDeviceDynamics {
  Scalar mass = Scalar(Omni::mass);                  ///< kg
  Scalar friction = Scalar(Omni::friction);          ///< dry friction, N
  Scalar encoder_step = Scalar(Omni::encoder_step);  ///< m; 0 is an ideal sensor
  Scalar max_force = Scalar(Omni::max_force);        ///< norm at which the motors saturate, N

  /// The force that the motors give for a commanded force, N.
  Vector3<Scalar> saturate(const Vector3<Scalar>& force) const noexcept {
    using namespace lane;
    // Nearly all forces are so far below that rounding cannot matter: they need neither root nor division.
    if (all(force.squaredNorm() < Lane<Scalar>(0.999) * max_force * max_force)) return force;
    const Scalar norm = force.norm();
    return select(norm > max_force, Vector3<Scalar>(force * (max_force / norm)), force);
  }

  void describe(auto& parameters) const { parameters.numbers(mass, friction, encoder_step, max_force); }
};

using DeviceDynamics = BasicDeviceDynamics<double>;
using DeviceDynamicsF = BasicDeviceDynamics<float>;

}  // namespace punctura
