// Three-dimensional vectors, m or N. Axes: right-handed, x right, y up, z towards the user.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "punctura/model/lane.hpp"

namespace punctura {

/// A vector of three numbers. It is trivially copyable, so that states and records can contain it.
///
/// The names are those of Eigen. `Eigen::Vector3d(v.data())` and `Vector3d(e.data())` convert to and from Eigen.
template <typename Scalar_>
class Vector3 {
 public:
  using Scalar = Scalar_;

  constexpr Vector3() noexcept = default;  ///< zero
  constexpr Vector3(Scalar x, Scalar y, Scalar z) noexcept : v_{x, y, z} {}
  constexpr explicit Vector3(const std::array<Scalar, 3>& v) noexcept : v_(v) {}
  Vector3(std::nullptr_t) = delete;  // Vector3(0) would read a null pointer
  constexpr explicit Vector3(const Scalar* v) noexcept : v_{v[0], v[1], v[2]} {}  ///< from three consecutive numbers

  static constexpr Vector3 Zero() noexcept { return {}; }
  static constexpr Vector3 Constant(Scalar s) noexcept { return {s, s, s}; }

  constexpr Scalar x() const noexcept { return v_[0]; }
  constexpr Scalar y() const noexcept { return v_[1]; }
  constexpr Scalar z() const noexcept { return v_[2]; }
  constexpr Scalar& x() noexcept { return v_[0]; }
  constexpr Scalar& y() noexcept { return v_[1]; }
  constexpr Scalar& z() noexcept { return v_[2]; }
  constexpr Scalar operator[](std::size_t i) const noexcept { return v_[i]; }
  constexpr Scalar& operator[](std::size_t i) noexcept { return v_[i]; }
  constexpr const Scalar* data() const noexcept { return v_.data(); }
  constexpr auto begin() const noexcept { return v_.begin(); }
  constexpr auto end() const noexcept { return v_.end(); }
  constexpr auto begin() noexcept { return v_.begin(); }
  constexpr auto end() noexcept { return v_.end(); }
  constexpr const std::array<Scalar, 3>& array() const noexcept { return v_; }

  template <typename Other>
  constexpr Vector3<Other> cast() const noexcept {
    return {static_cast<Other>(v_[0]), static_cast<Other>(v_[1]), static_cast<Other>(v_[2])};
  }

  constexpr bool operator==(const Vector3& b) const noexcept { return v_ == b.v_; }
  constexpr Vector3 operator-() const noexcept { return {-v_[0], -v_[1], -v_[2]}; }
  constexpr Vector3& operator+=(const Vector3& b) noexcept { return *this = *this + b; }
  constexpr Vector3& operator-=(const Vector3& b) noexcept { return *this = *this - b; }
  constexpr Vector3& operator*=(Scalar s) noexcept { return *this = *this * s; }
  constexpr Vector3& operator/=(Scalar s) noexcept { return *this = *this / s; }
  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
    return {a.v_[0] + b.v_[0], a.v_[1] + b.v_[1], a.v_[2] + b.v_[2]};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
    return {a.v_[0] - b.v_[0], a.v_[1] - b.v_[1], a.v_[2] - b.v_[2]};
  }
  friend constexpr Vector3 operator*(const Vector3& a, Scalar s) noexcept {
    return {a.v_[0] * s, a.v_[1] * s, a.v_[2] * s};
  }
  friend constexpr Vector3 operator*(Scalar s, const Vector3& a) noexcept { return a * s; }
  friend constexpr Vector3 operator/(const Vector3& a, Scalar s) noexcept {
    return {a.v_[0] / s, a.v_[1] / s, a.v_[2] / s};
  }

  constexpr void setZero() noexcept { *this = {}; }

  /// The order of the sums is fixed, because forces must keep the bits of the recorded ones. When they were recorded,
  /// float and double had different orders.
  constexpr Scalar dot(const Vector3& b) const noexcept {
    const Scalar x = v_[0] * b.v_[0], y = v_[1] * b.v_[1], z = v_[2] * b.v_[2];
    if constexpr (std::is_same_v<Lane<Scalar>, float>) return x + (y + z);
    return (x + y) + z;
  }
  constexpr Vector3 cross(const Vector3& b) const noexcept {
    return {v_[1] * b.v_[2] - v_[2] * b.v_[1], v_[2] * b.v_[0] - v_[0] * b.v_[2], v_[0] * b.v_[1] - v_[1] * b.v_[0]};
  }
  constexpr Scalar squaredNorm() const noexcept { return dot(*this); }
  constexpr Scalar norm() const noexcept {
    using namespace lane;
    return sqrt(squaredNorm());
  }

  /// The length, also if squares overflow or underflow. In lanes it must be finite, and no denormal number.
  constexpr Scalar stableNorm() const noexcept {
    const Scalar largest = maxAbs();
    if constexpr (OneNumber<Scalar>) {
      if (!allFinite()) return lane::abs(v_[0]) + lane::abs(v_[1]) + lane::abs(v_[2]);  // infinite, or NaN
      if (largest < 1 / std::numeric_limits<Scalar>::max())
        return std::hypot(v_[0], v_[1], v_[2]);  // 1 / largest would overflow
    }
    return largest * (*this * (1 / largest)).norm();
  }

  /// The vector scaled to length 1, also if squares overflow or underflow. A vector of length 0 stays unchanged.
  constexpr Vector3 stableNormalized() const noexcept {
    const Scalar largest = maxAbs();
    if (!(largest > 0)) return *this;
    return *this / (lane::sqrt((*this / largest).squaredNorm()) * largest);
  }
  constexpr Scalar maxAbs() const noexcept {
    using namespace lane;
    return max(max(abs(v_[0]), abs(v_[1])), abs(v_[2]));
  }
  constexpr Mask<Scalar> isZero() const noexcept { return v_[0] == 0 && v_[1] == 0 && v_[2] == 0; }
  constexpr bool allFinite() const noexcept {
    return lane::finite(v_[0]) && lane::finite(v_[1]) && lane::finite(v_[2]);
  }

 private:
  std::array<Scalar, 3> v_{};
};

using Vector3d = Vector3<double>;

template <typename M, Lanes V>
constexpr Vector3<V> select(const M& mask, const Vector3<V>& a, const Vector3<V>& b) noexcept {
  return {select(mask, a.x(), b.x()), select(mask, a.y(), b.y()), select(mask, a.z(), b.z())};
}

/// Whether p (m) is a valid coordinate: finite, and at most 1000 km from 0. Beyond that, filters and couplings could
/// overflow.
template <typename Scalar>
constexpr Mask<Scalar> is_place(const Scalar& p) noexcept {
  using namespace lane;
  return abs(p) <= Lane<Scalar>(1e6);
}
/// Whether all coordinates of p (m) are valid.
template <typename Scalar>
constexpr Mask<Scalar> is_place(const Vector3<Scalar>& p) noexcept {
  return is_place(p.x()) && is_place(p.y()) && is_place(p.z());
}
/// Whether v has the length 1, within 0.5 %.
template <typename Scalar>
constexpr bool is_unit(const Vector3<Scalar>& v) noexcept {
  return lane::abs(v.squaredNorm() - 1) < Scalar(1e-2);
}
static_assert(std::is_trivially_copyable_v<Vector3d>);

/// The vector as three doubles, the type that records store.
template <OneNumber Scalar>
constexpr std::array<double, 3> to_array(const Vector3<Scalar>& v) noexcept {
  return v.template cast<double>().array();
}
constexpr Vector3d to_vector(const std::array<double, 3>& v) noexcept { return Vector3d(v); }

}  // namespace punctura
