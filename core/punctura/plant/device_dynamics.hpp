// The mechanics of an impedance-type haptic device as its user feels them at the tip.
#pragma once

#include "punctura/model/vector3.hpp"

namespace punctura {

/// Defaults: PHANTOM Omni, by its maker's data sheet (SensAble Technologies, about 2005): apparent mass at the tip 45 g,
/// backdrive friction 0.26 N, nominal position resolution 0.055 mm (450 dpi), largest force at the nominal position 3.3 N.
/// All four are nominal: the true ones change over the workspace and with the direction, which is not modelled here.
template <typename Scalar>
struct BasicDeviceDynamics {
  Scalar mass = Scalar(0.045);             ///< kg
  Scalar friction = Scalar(0.26);          ///< N, dry
  Scalar encoder_step = Scalar(0.055e-3);  ///< m; 0 is an ideal sensor
  Scalar max_force = Scalar(3.3);          ///< N, norm, at which the motors saturate

  Vector3<Scalar> saturate(const Vector3<Scalar>& force) const noexcept {
    const Scalar norm = force.norm();
    return norm > max_force ? force * (max_force / norm) : force;
  }
};

using DeviceDynamics = BasicDeviceDynamics<double>;
using DeviceDynamicsF = BasicDeviceDynamics<float>;

}  // namespace punctura
