// K06's own solver, to the letter: the band is taken at q*, an explicit guess of where the proxy will be.
#pragma once

#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"

namespace punctura {

struct Paper {
  /// One tick on the axis of the needle: p (m), the depth of the device. K06 (33)
  template <typename L, typename C>
  static LineTick<typename L::Scalar> step(const LineParams<L, C>& params, LineState<L, C>& state,
                                           typename L::Scalar p) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    const C& c = params.coupling;
    const Scalar p_prev = select(state.started, state.p, p);
    const Scalar f_star = c.holding_force(p, p_prev, state.e, state.coupling);             // K06 (27)
    const Scalar q_star = p + c.free_offset(state.e, state.coupling) + c.inv_g * state.f;  // K06 (31)
    const Band<Scalar> band = pieces_now(params, state).band(q_star);                      // K06 (18), (19)
    const Friction<Scalar> friction = clamped_friction(band, f_star);                      // K06 (32)
    settle(params, state, p, p_prev, f_star, friction);                                    // K06 (25)
    return {friction.force, p + state.e, q_star, band, friction.phase};
  }

  /// One tick in space: p (m), the position of the device, and the needle's unit direction. K06 (41)
  template <typename L, typename C>
  static SpaceTick<typename L::Scalar> step(const SpaceParams<L, C>& params, SpaceState<L, C>& state,
                                            const Vector3<typename L::Scalar>& p,
                                            const Vector3<typename L::Scalar>& axis) noexcept {
    using namespace lane;
    using Scalar = typename L::Scalar;
    using Vector = Vector3<Scalar>;
    const auto& [law, a, n, c] = params;
    const Vector p_prev = select(state.started, state.p, p);
    const Vector f_star = c.holding_force(p, p_prev, state.e, state.coupling);             // K06 (38)
    const Vector q_star = p + c.free_offset(state.e, state.coupling) + c.inv_g * state.f;  // K06 (40)

    const auto in_front = n.dot(q_star - a) <= 0;  // K06 (41), first case
    const auto passed = !in_front && state.phase == Phase::outside;
    state.phase = select(in_front, PhaseOf<Scalar>(Phase::outside), state.phase);
    if (any(passed)) enter(params, state, axis, passed);
    const auto is_inside = inside(state.phase);
    if (!any(is_inside)) return settle_outside(params, state, p);

    const Scalar s = n.dot(q_star - a) / state.cos_beta;  // K06 (41)
    const Friction<Scalar> friction = clamped_friction(state.pieces.band(s), state.b.dot(f_star));
    if (all(is_inside)) return settle_inside(params, state, p, p_prev, f_star, friction, s);  // K06 (39), (25)
    return settle_each(params, state, p, p_prev, f_star, friction, s, is_inside);
  }
};

}  // namespace punctura
