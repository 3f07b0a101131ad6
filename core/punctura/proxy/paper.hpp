// The paper's solver: K06 (33) and (41), line by line. The slips of the printed text are corrected (docs/errata.md).
#pragma once

#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"

namespace punctura {

/// The paper's solver, Solver::paper: K06 (33) on a line and (41) in space.
///
/// It takes the band at q*, an explicit estimate of the proxy's position q, instead of at q.
struct Paper {
  /// One tick on the axis of the needle. p: depth of the device, m. K06 (33)
  template <typename L, typename C>
  static constexpr LineTick<typename L::Scalar> step(const LineParams<L, C>& params, LineState<L, C>& state,
                                                     typename L::Scalar p) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    const C& c = params.coupling;
    const Scalar p_prev = select(state.started, state.p, p);  // p(k-1); in the first tick p(k)
    const Scalar q_star = p + c.free_offset(state.e, state.coupling) + c.inv_g * state.f;  // K06 (31): line 1 of (33)
    const Scalar f_star = c.holding_force(p, p_prev, state.e, state.coupling);             // K06 (27): line 2 of (33)
    const Band<Scalar> band = pieces_now(params, state).band(q_star);                      // K06 (18), (19) at q*
    const Friction<Scalar> friction = clamped_friction(band, f_star);                      // K06 (32): line 3 of (33)
    settle(params, state, p, p_prev, f_star, friction);                                    // K06 (25): line 4 of (33)
    return {friction.force, p + state.e, q_star, band, friction.phase};
  }

  /// One tick in space. p: position of the device, m. axis: the needle's unit direction. K06 (41)
  template <typename L, typename C>
  [[gnu::always_inline]] static constexpr SpaceTick<typename L::Scalar> step(
      const SpaceParams<L, C>& params, SpaceState<L, C>& state, const Vector3<typename L::Scalar>& p,
      const Vector3<typename L::Scalar>& axis) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    using Vector = Vector3<Scalar>;
    const auto& [law, a, n, c] = params;
    const Vector& p_prev = previous(state, p);  // p(k-1); in the first tick p(k)
    const Vector q_star = p + c.free_offset(state.e, state.coupling) + c.inv_g * state.f;  // K06 (40), (41): q*

    const auto in_front = n.dot(q_star - a) <= 0;                    // K06 (41), IF: the tip is in front
    const auto passed = !in_front && state.phase == Phase::outside;  // K06 (41), inner IF: the tip was in front before
    state.phase = select(in_front, PhaseOf<Scalar>(Phase::outside), state.phase);
    if (any(passed)) enter(params, state, axis, passed);  // K06 (41): b and U
    const auto is_inside = inside(state.phase);
    if (!any(is_inside)) return settle_outside(params, state, p);  // K06 (41): f = 0; (25)

    const Vector f_star = c.holding_force(p, p_prev, state.e, state.coupling);           // K06 (38), (41): f*
    const Scalar s = n.dot(q_star - a) / state.cos_beta;                                 // K06 (41): q* along b
    const Scalar f_star_b = state.b.dot(f_star);                                         // K06 (41): b.f*
    const Friction<Scalar> friction = clamped_friction(state.pieces.band(s), f_star_b);  // K06 (32), (41): b.f
    if constexpr (Lanes<Scalar>)
      if (!all(is_inside)) return settle_each(params, state, p, p_prev, f_star, friction, s, is_inside);
    return settle_inside(params, state, p, p_prev, f_star, friction, s);  // K06 (39), (25)
  }
};

}  // namespace punctura
