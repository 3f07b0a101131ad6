// The true solution of K06 (21)-(23): the proxy sticks, or slides to the first depth where coupling and friction agree.
#pragma once

#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"

namespace punctura {

struct Exact {
  /// One tick on the axis of the needle: p (m), the depth of the device. K06 (21)-(23)
  template <typename L, typename C>
  static LineTick<typename L::Scalar> step(const LineParams<L, C>& params, LineState<L, C>& state,
                                           typename L::Scalar p) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    const C& c = params.coupling;
    const Scalar p_prev = select(state.started, state.p, p);
    const Scalar q_prev = p_prev + state.e;
    const Scalar f_star = c.holding_force(p, p_prev, state.e, state.coupling);  // K06 (27)
    const auto& pieces = pieces_now(params, state);
    const Friction<Scalar> friction = exact_friction(pieces, q_prev, f_star, c.g);  // K06 (21)-(23)
    settle(params, state, p, p_prev, f_star, friction);                             // K06 (25), (26)
    const Scalar q = p + state.e;
    return {friction.force, q, q, pieces.band(q), friction.phase};
  }

  /// One tick in space: p (m), the position of the device, and the needle's unit direction. K06 (41) with (21)-(23)
  template <typename L, typename C>
  static SpaceTick<typename L::Scalar> step(const SpaceParams<L, C>& params, SpaceState<L, C>& state,
                                            const Vector3<typename L::Scalar>& p,
                                            const Vector3<typename L::Scalar>& axis) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    using Vector = Vector3<Scalar>;
    const auto& [law, a, n, c] = params;
    const Vector p_prev = select(state.started, state.p, p);
    const Vector f_star = c.holding_force(p, p_prev, state.e, state.coupling);  // K06 (38)

    if (const auto was_outside = !inside(state.phase); any(was_outside)) {
      const Vector q_free = p + c.free_offset(state.e, state.coupling);  // without friction
      const auto in_front = n.dot(q_free - a) <= 0;
      const auto passed = !in_front && state.phase == Phase::outside;
      state.phase = select(was_outside && in_front, PhaseOf<Scalar>(Phase::outside), state.phase);
      if (any(passed)) enter(params, state, axis, passed);
    }
    const auto is_inside = inside(state.phase);
    if (!any(is_inside)) return settle_outside(params, state, p);

    const Vector q_prev = p_prev + state.e;
    const Scalar s_prev = n.dot(q_prev - a) / state.cos_beta, f_star_b = state.b.dot(f_star);
    const Friction<Scalar> friction = exact_friction(state.pieces, s_prev, f_star_b, c.g);  // K06 (21)-(23) along b
    const Scalar s = s_prev + (friction.force - f_star_b) * c.inv_g;                        // K06 (37) along b
    // The solution alone decides that the membrane is left. With H = 0 the proxy may rest on the surface under load.
    const auto left = is_inside && s <= 0 && friction.force == 0;
    state.phase = select(left, PhaseOf<Scalar>(Phase::outside), state.phase);
    const auto stays = is_inside && !left;
    if (!any(stays)) return settle_outside(params, state, p);
    if (all(stays)) return settle_inside(params, state, p, p_prev, f_star, friction, s);  // K06 (39), (25)
    return settle_each(params, state, p, p_prev, f_star, friction, s, stays);
  }
};

}  // namespace punctura
