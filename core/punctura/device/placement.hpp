// The placement of the device in the scene.
#pragma once

#include <array>
#include <cmath>

#include "punctura/device/sample.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// The placement of a device in a scene: scene point = rotation * (scale * device point) + offset + tip_offset * axis.
///
/// By default, the needle's tip is the point that the device reports, as in K06 section 4: the joint of the stylus.
struct Placement {
  std::array<double, 4> rotation{1, 0, 0, 0};  ///< quaternion w, x, y, z, of any length except 0
  std::array<double, 3> offset{0, 0, 0};       ///< m, in the scene
  double scale = 1;                            ///< metres in the scene per metre of the device
  double tip_offset = 0;                       ///< distance from the device's point to the tip along the stylus, m

  bool operator==(const Placement&) const = default;
};

/// Converts samples from the device to the scene, and forces from the scene to the device.
///
/// The inverse rotation is applied to forces. Forces are not scaled.
class Placer {
 public:
  explicit Placer(const Placement& p) noexcept
      : rotation_(matrix(p.rotation)), offset_(to_vector(p.offset)), scale_(p.scale), tip_offset_(p.tip_offset) {}

  DeviceSample to_scene(const DeviceSample& from) const noexcept {
    DeviceSample to = from;
    const Vector3d axis = rotated(to_vector(from.axis));
    to.axis = to_array(axis);
    to.position = to_array(rotated(scale_ * to_vector(from.position)) + offset_ + tip_offset_ * axis);
    return to;
  }
  std::array<double, 3> to_device(const std::array<double, 3>& force) const noexcept {
    const auto& [x, y, z] = rotation_;  // the transposed matrix is the inverse
    return to_array(x * force[0] + y * force[1] + z * force[2]);
  }

 private:
  using Rows = std::array<Vector3d, 3>;

  /// The rotation matrix of a quaternion of any length, as rows.
  static Rows matrix(const std::array<double, 4>& wxyz) noexcept {
    auto [w, x, y, z] = wxyz;
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    w /= length, x /= length, y /= length, z /= length;
    return {Vector3d(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            Vector3d(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            Vector3d(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))};
  }
  Vector3d rotated(const Vector3d& v) const noexcept {
    return {rotation_[0].dot(v), rotation_[1].dot(v), rotation_[2].dot(v)};
  }

  Rows rotation_;
  Vector3d offset_;
  double scale_, tip_offset_;
};

}  // namespace punctura
