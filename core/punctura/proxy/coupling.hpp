// The virtual coupling between device and proxy, K06 (21).
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include "punctura/model/vector3.hpp"

namespace punctura {

/// Spring and damper between the device and the proxy: f = K e + B (e - e_prev) / T. K06 (21).
template <typename Scalar>
struct BasicCoupling {
  Scalar stiffness;  ///< K, N/m
  Scalar damping;    ///< B, N s/m
};

using Coupling = BasicCoupling<double>;
using CouplingF = BasicCoupling<float>;

/// What a proxy asks of its coupling, sampled with the period T. `Vector` is a scalar on one line, a Vector3 in space.
///
/// Any coupling that is linear in the offset of this tick can be one: f = f* + g (e - (e_prev - dp)), where f* is the force that
/// holds the proxy still. One that relaxes keeps the force of its branch in Memory, and
/// keeps it from fading into denormal numbers.
template <typename C, typename Vector>
concept SampledCouplingOf = requires(const C c, const Vector& v, typename C::template Memory<Vector>& memory) {
  requires std::is_trivially_copyable_v<typename C::template Memory<Vector>>;
  { c.g } -> std::convertible_to<typename C::Scalar>;      // N/m: force per proxy displacement within one tick
  { c.inv_g } -> std::convertible_to<typename C::Scalar>;  // m/N
  { c.holding_force(v, v, v, memory) } noexcept -> std::same_as<Vector>;  // f*(p, p_prev, e_prev), N
  { c.free_offset(v, memory) } noexcept -> std::same_as<Vector>;          // e after a tick without force, m
  { c.advance(memory, v, v) } noexcept;                                   // the tick is over: (memory, e, e_prev)
};

/// K06's coupling sampled with period T, and what every tick needs of it.
template <typename Scalar_>
struct SampledCoupling {
  using Scalar = Scalar_;
  template <typename Vector>
  struct Memory {};

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

  void describe(auto& parameters) const { parameters.numbers(K, B, T); }

  /// f*: the force that would hold the proxy still. K06 (27), (38).
  template <typename Vector>
  Vector holding_force(const Vector& p, const Vector& p_prev, const Vector& e_prev,
                       const Memory<Vector>&) const noexcept {
    return -g * (p - p_prev) + K * e_prev;
  }

  /// e after a tick without force, K06 (25) with f = 0.
  template <typename Vector>
  Vector free_offset(const Vector& e_prev, const Memory<Vector>&) const noexcept {
    return B_over_D * e_prev;
  }

  template <typename Vector>
  void advance(Memory<Vector>&, const Vector&, const Vector&) const noexcept {}
};

/// e, or 0 where it is far below any meaning: it fades by B / D a tick, and would end in denormal numbers, which many processors
/// compute slowly. Adding a number and taking it away again stops that without a branch.
template <typename Scalar>
Vector3<Scalar> without_denormals(const Vector3<Scalar>& e) noexcept {
  const auto far_below = Vector3<Scalar>::Constant(std::sqrt(std::numeric_limits<Lane<Scalar>>::min()));
  return (e + far_below) - far_below;
}

}  // namespace punctura
