// One proxy and one membrane in space (K06 section 3.2): parameters, state and result of a tick, as plain data.
#pragma once

#include <limits>
#include <type_traits>
#include <utility>

#include "punctura/model/law_flaw.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/exact_friction.hpp"

namespace punctura {

/// cos(80 degrees), the smallest n.b of a needle that enters. A needle with a smaller n.b grazes and gives no force,
/// because U = H / cos(beta) would grow without bound (docs/errata.md, E6).
template <typename Scalar>
inline constexpr Scalar grazing_cosine = Scalar(0.17364817766693034885);

/// The parameters of a proxy in space. They stay fixed while it runs.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>>
  requires SampledCouplingOf<C, Vector3<typename L::Scalar>>
struct SpaceParams {
  static_assert(check_memory<L>());
  static_assert(!(LawWithMemory<L> && Lanes<typename L::Scalar>),
                "a law with memory works on one number; for lanes, see LanesThatRemember");
  using Vector = Vector3<typename L::Scalar>;

  L law;
  Vector a;  ///< any point of the surface, m
  Vector n;  ///< inward normal, of length 1
  C coupling;

  void describe(auto& parameters) const {
    describe_law(law, untouched_pieces(law, typename L::Scalar(1)), parameters);
    parameters.fields(a, n);
    coupling.describe(parameters);
  }
};

/// Whether the pieces of a law have had a flaw since the last reset. Only a law that MayHaveFlaws is watched.
struct Watch {
  bool flawed = false;
};
struct NoWatch {};
/// What a proxy then reports: ServoGuard ends the force.
template <typename Scalar>
inline constexpr Band<Scalar> no_band{std::numeric_limits<Scalar>::quiet_NaN(),
                                      std::numeric_limits<Scalar>::quiet_NaN()};

/// The state of a proxy between two ticks.
///
/// SpaceState<L>{} is the state before the first sample. A proxy that starts inside stays barred until it has been
/// outside, in front of the membrane.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>>
struct SpaceState {
  using Scalar = typename L::Scalar;
  using Vector = Vector3<Scalar>;

  Mask<Scalar> started{};
  PhaseOf<Scalar> phase = Phase::barred;
  Vector p{};            ///< p(k), m: the device's position
  Vector e{};            ///< e(k) = q(k) - p(k), m
  Vector f{};            ///< f(k), N
  Vector b{};            ///< the needle's direction at entry, constant while inside
  Scalar cos_beta{1};    ///< n.b
  PiecesOf<L> pieces{};  ///< the pieces of the law for cos_beta, valid while inside
  typename MemoryOf<L>::type law{};
  typename C::template Memory<Vector> coupling{};
  [[no_unique_address]] std::conditional_t<MayHaveFlaws<L>, Watch, NoWatch> watch{};

  /// Reads or writes the state without the pieces. lay_out() computes them.
  static void archive(auto& self, auto& state) {
    state.fields(self.started);
    state.choice(self.phase, Phase::barred);
    state.fields(self.p, self.e, self.f, self.b, self.cos_beta, self.law, self.coupling);
    state.require(is_place(self.p));
    if (inside(self.phase))
      state.require(self.started && is_unit(self.b) && self.cos_beta >= grazing_cosine<Scalar> &&
                    self.cos_beta < Scalar(1.01));
  }
};

/// The result of a tick in space.
template <typename Scalar>
struct SpaceTick {
  Vector3<Scalar> force;      ///< f(k), N, on the device
  Vector3<Scalar> proxy;      ///< q(k), m
  Vector3<Scalar> direction;  ///< b, constant from entry on
  Scalar axial_force;         ///< b.f(k), N
  /// m. Inside: the depth of the proxy q(k) along b; with the paper's solver the depth of q*. Otherwise: the depth of
  /// q(k) along the normal, from the surface.
  Scalar depth;
  Band<Scalar> band;  ///< the band at depth, N: it bounds the axial force; 0 outside
  PhaseOf<Scalar> phase;

  static void archive(auto& self, auto& state) {
    state.fields(self.force, self.proxy, self.direction, self.axial_force, self.depth, self.band.lower,
                 self.band.upper);
    state.choice(self.phase, Phase::barred);
  }
};

template <typename M, Lanes V>
constexpr SpaceTick<V> select(const M& mask, const SpaceTick<V>& a, const SpaceTick<V>& b) noexcept {
  return {select(mask, a.force, b.force),         select(mask, a.proxy, b.proxy),
          select(mask, a.direction, b.direction), select(mask, a.axial_force, b.axial_force),
          select(mask, a.depth, b.depth),         select(mask, a.band, b.band),
          select(mask, a.phase, b.phase)};
}

template <typename L, typename C>
constexpr void look_for_flaws([[maybe_unused]] const SpaceParams<L, C>& params,
                              [[maybe_unused]] SpaceState<L, C>& state) noexcept {
  if constexpr (MayHaveFlaws<L>) state.watch.flawed = state.watch.flawed || has_flaw(params.law, state.pieces);
}

/// Computes the pieces of the law for the angle of the needle and for the memory of the membrane.
template <typename L, typename C>
constexpr void lay_out(const SpaceParams<L, C>& params, SpaceState<L, C>& state) noexcept {
  if constexpr (LawWithMemory<L>)
    state.pieces = params.law.pieces(state.cos_beta, state.law);
  else
    state.pieces = params.law.pieces(state.cos_beta);
  look_for_flaws(params, state);
}

/// p(k-1), m; in the first tick p(k). For one number it is state.p itself, until the tick ends: a copy would cost time.
template <typename L, typename C, typename Scalar>
[[gnu::always_inline]] constexpr decltype(auto) previous(SpaceState<L, C>& state, const Vector3<Scalar>& p) noexcept {
  if constexpr (OneNumber<Scalar>) {
    if (!state.started) state.p = p;
    return std::as_const(state.p);
  } else {
    if (!all(state.started)) state.p = select(state.started, state.p, p);
    return Vector3<Scalar>(state.p);
  }
}

/// Fixes b and U at entry, K06 (41) and (17), for the lanes in which the tip has `passed` the surface. They stay
/// until the tip leaves.
///
/// A needle that grazes becomes barred.
template <typename L, typename C>
constexpr void enter(const SpaceParams<L, C>& params, SpaceState<L, C>& state,
                     const typename SpaceState<L, C>::Vector& axis, const Mask<typename L::Scalar>& passed) noexcept {
  using namespace lane;
  using Scalar = typename L::Scalar;
  using P = PhaseOf<Scalar>;
  const Scalar cos_beta = params.n.dot(axis);
  const auto enters = passed && cos_beta >= grazing_cosine<Lane<Scalar>>;
  state.phase = select(passed, select(enters, P(Phase::sticking), P(Phase::barred)), state.phase);
  state.cos_beta = select(passed, cos_beta, state.cos_beta);
  if (!any(enters)) return;
  state.b = select(enters, axis, state.b);
  lay_out(params, state);  // a lane that is inside already keeps its cos_beta, and so its pieces
}

/// Ends a tick inside: computes the force and moves the proxy, from the friction along b.
///
/// A tick in space is always inlined as a whole, so that the compiler leaves out what nobody reads, and keeps the rest
/// in registers: the processor waits when it loads a vector whose numbers have just been stored one by one.
/// docs/decisions/tick-in-space.md has the figures.
template <typename L, typename C, typename Scalar>
[[gnu::always_inline]] constexpr SpaceTick<Scalar> settle_inside(
    const SpaceParams<L, C>& params, SpaceState<L, C>& state, const Vector3<Scalar>& p, const Vector3<Scalar>& p_prev,
    const Vector3<Scalar>& f_star, const Friction<Scalar>& friction, Scalar depth) noexcept {
  const Vector3<Scalar> e_prev = state.e;
  Band<Scalar> band = state.pieces.band(depth);
  if constexpr (MayHaveFlaws<L>)
    if (state.watch.flawed) band = no_band<Scalar>;
  state.f = f_star + state.b * (friction.force - state.b.dot(f_star));           // K06 (39)
  state.e = e_prev - (p - p_prev) + params.coupling.inv_g * (state.f - f_star);  // K06 (25), (37)
  params.coupling.advance(state.coupling, state.e, e_prev);
  state.started = Mask<Scalar>(true);
  state.p = p;
  if constexpr (LanesThatRemember<L>)
    if (params.law.remembers())
      params.law.advance(params.n.dot(p + state.e - params.a) / state.cos_beta, inside(state.phase));
  state.phase = friction.phase;
  if constexpr (LawWithMemory<L>) {
    const Scalar now = params.n.dot(p + state.e - params.a) / state.cos_beta;
    if (advance_memory(params.law, state.law, now, time_step<L>(params.coupling))) {
      if constexpr (RefreshesPieces<L>) {
        params.law.refresh(state.pieces, state.law);
        look_for_flaws(params, state);
      } else {
        lay_out(params, state);
      }
    }
  }
  if constexpr (LooksAhead<PiecesOf<L>>) state.pieces.look_at(depth);
  return {state.f, p + state.e, state.b, friction.force, depth, band, friction.phase};
}

/// Ends a tick outside or barred: f = 0.
template <typename L, typename C, typename Scalar>
[[gnu::always_inline]] constexpr SpaceTick<Scalar> settle_outside(const SpaceParams<L, C>& params,
                                                                  SpaceState<L, C>& state,
                                                                  const Vector3<Scalar>& p) noexcept {
  const Vector3<Scalar> e_prev = state.e;
  state.f = {};                                                                      // K06 (41), outside
  state.e = without_denormals(params.coupling.free_offset(e_prev, state.coupling));  // K06 (25) with f = 0
  params.coupling.advance(state.coupling, state.e, e_prev);
  state.started = Mask<Scalar>(true);
  state.p = p;
  if constexpr (HearsLeaving<L>)
    if (state.phase == Phase::outside) params.law.leave(state.law);
  if constexpr (FeelsTime<L>) params.law.advance(state.law, 0, params.coupling.period());  // enter() lays it out
  if constexpr (LanesThatRemember<L>)
    if (params.law.remembers()) params.law.leave(state.phase == Phase::outside);
  return {state.f, p + state.e, state.b, 0, params.n.dot(p + state.e - params.a), {0, 0}, state.phase};
}

/// Ends a tick in which some lanes are inside and some are not.
template <typename L, typename C, Lanes Scalar>
constexpr SpaceTick<Scalar> settle_each(const SpaceParams<L, C>& params, SpaceState<L, C>& state,
                                        const Vector3<Scalar>& p, const Vector3<Scalar>& p_prev,
                                        const Vector3<Scalar>& f_star, const Friction<Scalar>& friction, Scalar depth,
                                        const Mask<Scalar>& is_inside) noexcept {
  using namespace lane;
  const auto e_prev = state.e;  // a copy of the whole state would take longer than the rest
  const auto coupling = state.coupling;
  const SpaceTick<Scalar> of_outside = settle_outside(params, state, p);
  const auto e = std::exchange(state.e, e_prev);
  [[maybe_unused]] const auto free_coupling = std::exchange(state.coupling, coupling);
  const SpaceTick<Scalar> of_inside = settle_inside(params, state, p, p_prev, f_star, friction, depth);
  state.phase = select(is_inside, state.phase, of_outside.phase);
  state.e = select(is_inside, state.e, e);
  state.f = select(is_inside, state.f, of_outside.force);
  if constexpr (!std::is_empty_v<decltype(state.coupling)>)
    state.coupling = select(is_inside, state.coupling, free_coupling);
  return select(is_inside, of_inside, of_outside);
}

}  // namespace punctura
