// The proxy of K06 section 3.2: one proxy and one membrane in space.
#pragma once

#include <limits>
#include <type_traits>

#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"

namespace punctura {

template <typename Scalar, typename Proxies, typename Storage>
class ConditionedProxies;

/// The proxy of K06 Fig. 7. Inside, it moves only along b, the needle's direction at entry, and friction acts only
/// along b.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>>
class Proxy3d {
 public:
  using Scalar = typename L::Scalar;
  using Vector = Vector3<Scalar>;
  using Params = SpaceParams<L, C>;
  using State = SpaceState<L, C>;
  static_assert(std::is_trivially_copyable_v<State>);

  /// point: a, any point of the surface, m. inward_normal: n, of length 1. period: T, s.
  constexpr Proxy3d(const L& law, const Vector& point, const Vector& inward_normal, const C& coupling,
                    Solver solver = Solver::exact) noexcept
      : params_{law, point, inward_normal, coupling}, solver_(solver) {
    reset();
  }
  constexpr Proxy3d(const L& law, const Vector& point, const Vector& inward_normal,
                    const BasicCoupling<Scalar>& coupling, Scalar period, Solver solver = Solver::exact) noexcept
      : Proxy3d(law, point, inward_normal, C(coupling, period), solver) {}

  /// Clears the state. A proxy that starts inside stays barred until it has been outside, in front.
  constexpr void reset() noexcept { state_ = {}; }

  /// One tick. p: position of the device, m. axis: the needle's unit direction. Returns the force on the device, N.
  /// K06 (41).
  ///
  /// If p is NaN or beyond 1000 km, or axis is not finite, it returns NaN and the state does not change.
  constexpr Vector step(const Vector& p, const Vector& axis) noexcept {
    if (!is_place(p) || !axis.allFinite()) return Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    return step_finite(p, axis);
  }
  /// Whether another proxy is at the same membrane.
  template <typename OtherLaw, typename OtherCoupling>
  constexpr bool same_place(const Proxy3d<OtherLaw, OtherCoupling>& other) const noexcept {
    return params_.a == other.params().a && params_.n == other.params().n;
  }
  /// Takes over the state of another proxy at the same membrane, but keeps its own law and coupling.
  ///
  /// Memory of the same type is kept. Otherwise the branches of the coupling begin without force, and a law with memory
  /// begins with an untouched wall. A needle that is inside has cut up to its present depth. It is barred if the law
  /// does not go on from the previous one.
  template <typename OtherLaw, typename OtherCoupling>
  constexpr void resume(const Proxy3d<OtherLaw, OtherCoupling>& previous) noexcept {
    const auto& old = previous.state();
    state_ = {old.started, old.phase, old.p, old.e, old.f, old.b, old.cos_beta};
    keep(previous.tick());
    if constexpr (std::is_same_v<decltype(state_.coupling), std::remove_cvref_t<decltype(old.coupling)>>) {
      state_.coupling = old.coupling;
      if constexpr (requires { params_.coupling.clear_unused(state_.coupling); })
        params_.coupling.clear_unused(state_.coupling);
    }
    if constexpr (std::is_same_v<decltype(state_.law), std::remove_cvref_t<decltype(old.law)>>) state_.law = old.law;
    if (!inside(state_.phase)) return;
    if (!goes_on_from(params_.law, previous.law())) {
      state_.phase = Phase::barred;
      state_.f = {};
      return;
    }
    if constexpr (LawWithMemory<L>) {
      const auto depth = params_.n.dot(position() - params_.a) / state_.cos_beta;
      advance_memory(params_.law, state_.law, depth, Scalar(0));
    }
    lay_out(params_, state_);
  }

  /// The complete state of the solver, to look at. To go back to a tick later, copy the whole proxy, or use
  /// save_state() and load_state(): they also keep what tick() has beside it.
  constexpr const State& state() const noexcept { return state_; }
  static void archive(auto& self, auto& state) {
    constexpr bool reading = std::remove_reference_t<decltype(state)>::reading;
    State::archive(self.state_, state);
    if constexpr (reading) {
      self.state_.watch = {};
      if (self.is_inside()) lay_out(self.params_, self.state_);
    }
    SpaceTick<Scalar> last = self.tick();
    state.fields(last.axial_force, last.depth, last.band.lower, last.band.upper);
    if constexpr (reading) self.keep(last);
  }
  void describe(auto& parameters) const {
    params_.describe(parameters);
    parameters.choice(solver_, solver_);
  }

  constexpr const Params& params() const noexcept { return params_; }
  constexpr Solver solver() const noexcept { return solver_; }
  constexpr SpaceTick<Scalar> tick() const noexcept {
    return {state_.f, position(), state_.b, axial_force(), depth(), band(), state_.phase};
  }
  constexpr const L& law() const noexcept { return params_.law; }
  constexpr const Vector& force() const noexcept { return state_.f; }         ///< f(k), N
  constexpr const Vector& offset() const noexcept { return state_.e; }        ///< e(k) = q(k) - p(k), m
  constexpr Vector position() const noexcept { return state_.p + state_.e; }  ///< q(k), m
  constexpr const Vector& direction() const noexcept { return state_.b; }     ///< b, constant from entry on
  constexpr Phase phase() const noexcept { return state_.phase; }
  constexpr Scalar axial_force() const noexcept { return is_inside() ? axial_force_ : Scalar(0); }  ///< b.f(k), N
  /// The band of the axial force, N.
  constexpr Band<Scalar> band() const noexcept {
    if (!is_inside()) return {0, 0};
    if constexpr (LawWithMemory<L> || MayHaveFlaws<L>)
      return band_;
    else
      return state_.pieces.band(depth_);
  }
  /// m, see SpaceTick.
  constexpr Scalar depth() const noexcept {
    if (is_inside()) return depth_;
    return state_.started ? params_.n.dot(position() - params_.a) : Scalar(0);
  }

 private:
  template <typename, typename, typename>
  friend class ConditionedProxies;  // it checks p and axis once for all membranes

  /// step() without the check of p and axis.
  [[gnu::always_inline]] constexpr Vector step_finite(const Vector& p, const Vector& axis) noexcept {
    if (solver_ == Solver::paper)
      keep(Paper::step(params_, state_, p, axis));
    else
      keep(Exact::step(params_, state_, p, axis));
    return state_.f;
  }
  constexpr bool is_inside() const noexcept { return inside(state_.phase); }
  /// Stores what tick() cannot compute from the state. The compiler then leaves the rest of the result out of a tick.
  [[gnu::always_inline]] constexpr void keep(const SpaceTick<Scalar>& tick) noexcept {
    if (!inside(tick.phase)) return;
    axial_force_ = tick.axial_force;
    depth_ = tick.depth;
    if constexpr (LawWithMemory<L> || MayHaveFlaws<L>) band_ = tick.band;  // the law may have changed since
  }

  Params params_;
  Solver solver_;
  State state_{};
  Scalar axial_force_{}, depth_{};  ///< of the last tick inside, as in SpaceTick
  Band<Scalar> band_{};
};

}  // namespace punctura
