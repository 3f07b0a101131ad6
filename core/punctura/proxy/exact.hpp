// The exact solver: it solves K06 (21)-(23). The lines follow (33) and (41); the comments give the equations.
#pragma once

#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"

namespace punctura {

/// The exact solver, Solver::exact: the true solution of K06 (21)-(23).
///
/// The proxy sticks, or it slides to the first depth where the force of the coupling equals the friction.
struct Exact {
  /// One tick on the axis of the needle. p: depth of the device, m. K06 (21)-(23)
  template <typename L, typename C>
  static constexpr LineTick<typename L::Scalar> step(const LineParams<L, C>& params, LineState<L, C>& state,
                                                     typename L::Scalar p) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    const C& c = params.coupling;
    const Scalar p_prev = select(state.started, state.p, p);                        // p(k-1); in the first tick p(k)
    const Scalar q_prev = p_prev + state.e;                                         // K06 (22)
    const Scalar f_star = c.holding_force(p, p_prev, state.e, state.coupling);      // K06 (27)
    const auto& pieces = pieces_now(params, state);                                 // K06 (18), (19)
    const Friction<Scalar> friction = exact_friction(pieces, q_prev, f_star, c.g);  // K06 (21)-(23)
    settle(params, state, p, p_prev, f_star, friction);                             // K06 (25), (26)
    const Scalar q = p + state.e;                                                   // K06 (22)
    return {friction.force, q, q, pieces.band(q), friction.phase};
  }

  /// One tick in space. p: position of the device, m. axis: the needle's unit direction. K06 (41), with (21)-(23) for
  /// f_b
  template <typename L, typename C>
  [[gnu::always_inline]] static constexpr SpaceTick<typename L::Scalar> step(
      const SpaceParams<L, C>& params, SpaceState<L, C>& state, const Vector3<typename L::Scalar>& p,
      const Vector3<typename L::Scalar>& axis) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    using Vector = Vector3<Scalar>;
    const auto& [law, a, n, c] = params;
    const Vector& p_prev = previous(state, p);  // p(k-1); in the first tick p(k)

    if (const auto was_outside = !inside(state.phase); any(was_outside)) {
      const Vector q_free = p + c.free_offset(state.e, state.coupling);  // K06 (40) with f = 0
      const auto in_front = n.dot(q_free - a) <= 0;                      // K06 (41), IF: the tip is in front
      const auto passed = !in_front && state.phase == Phase::outside;
      state.phase = select(was_outside && in_front, PhaseOf<Scalar>(Phase::outside), state.phase);
      if (any(passed)) enter(params, state, axis, passed);  // K06 (41), inner IF: b and U
    }
    const auto is_inside = inside(state.phase);
    if (!any(is_inside)) return settle_outside(params, state, p);  // K06 (41): f = 0; (25)

    const Vector f_star = c.holding_force(p, p_prev, state.e, state.coupling);              // K06 (38)
    const Vector q_prev = p_prev + state.e;                                                 // q(k-1)
    const Scalar s_prev = n.dot(q_prev - a) / state.cos_beta;                               // K06 (41), for q(k-1)
    const Scalar f_star_b = state.b.dot(f_star);                                            // K06 (41): b.f*
    const Friction<Scalar> friction = exact_friction(state.pieces, s_prev, f_star_b, c.g);  // K06 (21)-(23) along b
    const Scalar s = s_prev + (friction.force - f_star_b) * c.inv_g;                        // K06 (37) along b
    // The proxy leaves the membrane only by this solution. With H = 0 the proxy can rest on the surface under load.
    const auto left = is_inside && s <= 0 && friction.force == 0;
    state.phase = select(left, PhaseOf<Scalar>(Phase::outside), state.phase);
    const auto stays = is_inside && !left;
    if (!any(stays)) return settle_outside(params, state, p);
    if constexpr (Lanes<Scalar>)
      if (!all(stays)) return settle_each(params, state, p, p_prev, f_star, friction, s, stays);
    return settle_inside(params, state, p, p_prev, f_star, friction, s);  // K06 (39), (25)
  }
};

}  // namespace punctura
