// One proxy on the axis of the needle (K06 section 3.1): parameters, state and result of a tick, as plain data.
#pragma once

#include <type_traits>
#include <utility>

#include "punctura/model/law.hpp"
#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/exact_friction.hpp"

namespace punctura {

/// The parameters of a proxy on a line. They stay fixed while it runs.
template <Law L, typename C = SampledCoupling<typename L::Scalar>>
  requires SampledCouplingOf<C, typename L::Scalar>
struct LineParams {
  static_assert(check_memory<L>());
  static_assert(!(LawWithMemory<L> && Lanes<typename L::Scalar>),
                "a law with memory works on one number, not on lanes");
  L law;
  C coupling;

  void describe(auto& parameters) const {
    describe_law(law, untouched_pieces(law), parameters);
    coupling.describe(parameters);
  }
};

/// The state of a proxy between two ticks. LineState<L>{} is the state before the first sample: e = f = 0.
template <Law L, typename C = SampledCoupling<typename L::Scalar>>
struct LineState {
  using Scalar = typename L::Scalar;

  Mask<Scalar> started{};
  PhaseOf<Scalar> phase = Phase::sticking;
  Scalar p{};  ///< p(k), m: the device's depth
  Scalar e{};  ///< e(k) = q(k) - p(k), m
  Scalar f{};  ///< f(k), N
  typename MemoryOf<L>::type law{};
  /// The pieces of a law with memory, from the first tick on. A law without memory stores its own.
  std::conditional_t<LawWithMemory<L>, PiecesOf<L>, NoMemory> pieces{};
  typename C::template Memory<Scalar> coupling{};

  /// Reads or writes the state without the pieces. lay_out() computes them.
  static void archive(auto& self, auto& state) {
    state.fields(self.started);
    state.choice(self.phase, Phase::sliding_out);
    state.fields(self.p, self.e, self.f, self.law, self.coupling);
    state.require(inside(self.phase) && is_place(self.p));
  }
};

template <typename Scalar>
struct LineTick {
  Scalar force;       ///< f(k), N, on the device
  Scalar proxy;       ///< q(k), m
  Scalar depth;       ///< the depth of the band, m: q(k); with the paper's solver q*
  Band<Scalar> band;  ///< the band at depth, N
  PhaseOf<Scalar> phase;
};

/// Computes the pieces of the law for the memory of the membrane.
template <typename L, typename C>
constexpr void lay_out(const LineParams<L, C>& params, LineState<L, C>& state) noexcept {
  if constexpr (LawWithMemory<L>) state.pieces = pieces_for(params.law, state.law);
}

/// The pieces of the law for the present memory of the membrane: a value where pieces() of the law returns one.
template <typename L, typename C>
constexpr decltype(auto) pieces_now(const LineParams<L, C>& params, LineState<L, C>& state) noexcept {
  if constexpr (LawWithMemory<L>) {
    if (!state.started) lay_out(params, state);
    return std::as_const(state.pieces);
  } else {
    return untouched_pieces(params.law);
  }
}

/// Tells a law with memory where the proxy is. q: its depth, m. force: N
///
/// The tip has left when it is outside without a force. On a wall of thickness 0 it can rest on the surface under load.
template <typename L, typename C, typename Scalar>
constexpr void remember(const LineParams<L, C>& params, LineState<L, C>& state, const Scalar& q,
                        const Scalar& force) noexcept {
  bool changed = advance_memory(params.law, state.law, q, time_step<L>(params.coupling));
  if constexpr (HearsLeaving<L>)
    if (!(q > 0) && force == 0) changed |= params.law.leave(state.law);
  if (changed) {
    if constexpr (RefreshesPieces<L>)
      params.law.refresh(state.pieces, state.law);
    else
      lay_out(params, state);
  }
  if constexpr (LooksAhead<PiecesOf<L>>) state.pieces.look_at(q);
}

/// Ends a tick: moves the proxy, from the friction force.
template <typename L, typename C, typename Scalar>
constexpr void settle(const LineParams<L, C>& params, LineState<L, C>& state, Scalar p, Scalar p_prev, Scalar f_star,
                      const Friction<Scalar>& friction) noexcept {
  const Scalar e_prev = state.e;
  // K06 (25) and (26) combined. In this form, a proxy that sticks (f = f*) keeps its position to the last bit.
  state.e = e_prev - (p - p_prev) + params.coupling.inv_g * (friction.force - f_star);
  params.coupling.advance(state.coupling, state.e, e_prev);
  if constexpr (LawWithMemory<L>) remember(params, state, p + state.e, friction.force);
  state.started = Mask<Scalar>(true);
  state.p = p;
  state.f = friction.force;
  state.phase = friction.phase;
}

}  // namespace punctura
