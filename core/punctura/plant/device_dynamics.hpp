// The mechanics of an impedance-type haptic device as its user feels them at the tip.
#pragma once

#include "punctura/model/vector3.hpp"

namespace punctura {

/// Defaults: PHANTOM Omni, by its maker's data sheet (SensAble Technologies, about 2005): apparent mass at the tip 45 g,
/// backdrive friction 0.26 N, nominal position resolution 0.055 mm (450 dpi), largest force at the nominal position 3.3 N.
/// All four are nominal: the true ones change over the workspace and with the direction, which is not modelled here.
struct DeviceDynamics {
  double mass = 0.045;             ///< kg
  double friction = 0.26;          ///< N, dry
  double encoder_step = 0.055e-3;  ///< m; 0 is an ideal sensor
  double max_force = 3.3;          ///< N, norm, at which the motors saturate

  Vector3d saturate(const Vector3d& force) const noexcept {
    const double norm = force.norm();
    return norm > max_force ? Vector3d(force * (max_force / norm)) : force;
  }
};

}  // namespace punctura
