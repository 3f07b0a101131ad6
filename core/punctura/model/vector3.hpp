// Three-dimensional vectors, m or N. Axes: right-handed, x right, y up, z towards the user.
#pragma once

#include <Eigen/Core>
#include <array>

#include "punctura/model/finite_math.hpp"

namespace punctura {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

using Vector3d = Vector3<double>;

/// Plain storage for records: Eigen's vectors are not trivially copyable.
inline std::array<double, 3> plain(const Vector3d& v) noexcept { return {v.x(), v.y(), v.z()}; }
inline Vector3d vector(const std::array<double, 3>& v) noexcept { return {v[0], v[1], v[2]}; }

}  // namespace punctura
