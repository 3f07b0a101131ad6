// Where the device stands in the scene.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "punctura/device/sample.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// scene point = rotation * (scale * device point) + offset + tip_offset * axis.
///
/// The default puts the needle's tip at the device's own point, K06 section 4: the joint of the stylus.
struct Placement {
  std::array<double, 4> rotation{1, 0, 0, 0};  ///< w, x, y, z: a quaternion of any length but 0
  std::array<double, 3> offset{0, 0, 0};       ///< m, in the scene
  double scale = 1;                            ///< scene metres for a metre of the device
  double tip_offset = 0;                       ///< m along the stylus, from the device's point to the tip

  bool operator==(const Placement&) const = default;
};

/// A placement worked out. Forces go back by the inverse rotation, and are not scaled: a newton stays a newton.
class Placer {
 public:
  explicit Placer(const Placement& p) noexcept
      : rotation_(Eigen::Quaterniond(p.rotation[0], p.rotation[1], p.rotation[2], p.rotation[3])
                      .normalized()
                      .toRotationMatrix()),
        offset_(vector(p.offset)),
        scale_(p.scale),
        tip_offset_(p.tip_offset) {}

  DeviceSample to_scene(const DeviceSample& from) const noexcept {
    DeviceSample to = from;
    const Vector3d axis = rotation_ * vector(from.axis);
    to.axis = plain(axis);
    to.position = plain(Vector3d(rotation_ * (scale_ * vector(from.position)) + offset_ + tip_offset_ * axis));
    return to;
  }
  std::array<double, 3> to_device(const std::array<double, 3>& force) const noexcept {
    return plain(Vector3d(rotation_.transpose() * vector(force)));
  }

 private:
  Eigen::Matrix3d rotation_;
  Vector3d offset_;
  double scale_, tip_offset_;
};

}  // namespace punctura
