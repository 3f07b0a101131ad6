// The virtual coupling between device and proxy, K06 (21).
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include "punctura/model/field.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// A spring and a damper between device and proxy: f = K e + B (e - e_prev) / T, N. K06 (21).
template <typename Scalar>
struct BasicCoupling {
  Scalar stiffness = Scalar(not_given);  ///< K, N/m
  Scalar damping = Scalar(not_given);    ///< B, N s/m
};

using Coupling = BasicCoupling<double>;
using CouplingF = BasicCoupling<float>;

/// The requirements on a coupling that is sampled with the period T. `Vector` is a scalar on a line and a Vector3 in
/// space.
///
/// The force must be linear in the offset of this tick: f = f* + g (e - (e_prev - dp)), where f* is the force that
/// holds the proxy still. A coupling that relaxes stores the force of its branch in Memory. It must not let this
/// force decay into denormal numbers.
template <typename C, typename Vector>
concept SampledCouplingOf = requires(const C c, const Vector& v, typename C::template Memory<Vector>& memory) {
  requires std::is_trivially_copyable_v<typename C::template Memory<Vector>>;
  { c.g } -> std::convertible_to<typename C::Scalar>;      // N/m: force per proxy displacement within one tick
  { c.inv_g } -> std::convertible_to<typename C::Scalar>;  // m/N
  { c.holding_force(v, v, v, memory) } noexcept -> std::same_as<Vector>;  // f*(p, p_prev, e_prev), N
  { c.free_offset(v, memory) } noexcept -> std::same_as<Vector>;          // e after a tick without force, m
  { c.advance(memory, v, v) } noexcept;                                   // ends the tick: (memory, e, e_prev)
};

/// K06's coupling (21), sampled with the period T (s). It stores the constants that each tick needs.
template <typename Scalar_>
struct SampledCoupling {
  using Scalar = Scalar_;
  template <typename Vector>
  struct Memory {};

  Scalar K, B, T;
  Scalar g;         ///< (K T + B) / T, N/m: force per displacement of the proxy within one tick
  Scalar inv_g;     ///< T / (K T + B), m/N
  Scalar B_over_D;  ///< B / (K T + B): without force, e is this fraction of e_prev

  constexpr SampledCoupling(const BasicCoupling<Scalar>& coupling, Scalar period) noexcept
      : K(coupling.stiffness),
        B(coupling.damping),
        T(period),
        g(K + B / T),
        inv_g(T / (K * T + B)),
        B_over_D(B / (K * T + B)) {}

  constexpr Scalar period() const noexcept { return T; }  ///< s, for a law that feels time
  void describe(auto& parameters) const { parameters.fields(K, B, T); }

  /// f*, N: the force that holds the proxy still. K06 (27), (38).
  template <typename Vector>
  constexpr Vector holding_force(const Vector& p, const Vector& p_prev, const Vector& e_prev,
                                 const Memory<Vector>&) const noexcept {
    return -g * (p - p_prev) + K * e_prev;
  }

  /// e after a tick without force, m. K06 (25) with f = 0.
  template <typename Vector>
  constexpr Vector free_offset(const Vector& e_prev, const Memory<Vector>&) const noexcept {
    return B_over_D * e_prev;
  }

  template <typename Vector>
  constexpr void advance(Memory<Vector>&, const Vector&, const Vector&) const noexcept {}
};

/// e (m), rounded so that it never becomes a denormal number. The proxies in space use it.
///
/// Without force, e decays by the factor B / (K T + B) in each tick, and would become denormal. Many processors compute
/// slowly with denormal numbers. To add and subtract a tiny number prevents this without a branch.
template <typename Scalar>
constexpr Vector3<Scalar> without_denormals(const Vector3<Scalar>& e) noexcept {
  const auto tiny = Vector3<Scalar>::Constant(lane::sqrt(std::numeric_limits<Lane<Scalar>>::min()));
  return (e + tiny) - tiny;
}
/// The same on a line.
template <std::floating_point Scalar>
constexpr Scalar without_denormals(Scalar e) noexcept {
  const Scalar tiny = lane::sqrt(std::numeric_limits<Scalar>::min());
  return (e + tiny) - tiny;
}

}  // namespace punctura
