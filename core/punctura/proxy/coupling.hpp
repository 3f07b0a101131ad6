// The virtual coupling between device and proxy, K06 (21).
#pragma once

#include <cmath>
#include <limits>

namespace punctura {

/// Spring and damper between the device and the proxy: f = K e + B (e - e_prev) / T. K06 (21).
template <typename Scalar>
struct BasicCoupling {
  Scalar stiffness;  ///< K, N/m
  Scalar damping;    ///< B, N s/m
};

using Coupling = BasicCoupling<double>;
using CouplingF = BasicCoupling<float>;

/// The coupling sampled with period T, and what every tick needs of it.
template <typename Scalar>
struct SampledCoupling {
  Scalar K, B, T;
  Scalar g;         ///< (K T + B) / T, N/m: force per proxy displacement within one tick
  Scalar inv_g;     ///< T / (K T + B), m/N
  Scalar B_over_D;  ///< B / (K T + B): what is left of a free offset after one tick

  SampledCoupling(const BasicCoupling<Scalar>& coupling, Scalar period) noexcept
      : K(coupling.stiffness),
        B(coupling.damping),
        T(period),
        g(K + B / T),
        inv_g(T / (K * T + B)),
        B_over_D(B / (K * T + B)) {}

  /// The offset after a tick without force, K06 (25). It fades by B / D a tick; adding a number and taking it away again stops that
  /// far below any meaning, before it ends in denormal numbers, which many processors compute slowly.
  template <typename Vector>
  Vector relaxed(const Vector& e_prev) const noexcept {
    const Vector far_below = Vector::Constant(std::sqrt(std::numeric_limits<Scalar>::min()));
    return (B_over_D * e_prev + far_below) - far_below;
  }

  /// f*: the force that would hold the proxy still. K06 (27), (38).
  template <typename Vector>
  auto holding_force(const Vector& p, const Vector& p_prev, const Vector& e_prev) const noexcept {
    return -g * (p - p_prev) + K * e_prev;
  }
};

}  // namespace punctura
