// K06 section 3.2: one proxy, one membrane, in space.
#pragma once

#include <limits>

#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"

namespace punctura {

template <ObliqueLaw L, typename C, typename Storage>
class InsertionOf;

/// The proxy of K06 Fig. 7: it moves along b, the needle's direction at entry, and friction acts along b alone.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>>
class Proxy3d {
 public:
  using Scalar = typename L::Scalar;
  using Vector = Vector3<Scalar>;
  using Params = SpaceParams<L, C>;
  using State = SpaceState<L, C>;
  static_assert(std::is_trivially_copyable_v<State>);

  /// point: any point of the surface (a), m. inward_normal: n, of length 1.
  Proxy3d(const L& law, const Vector& point, const Vector& inward_normal, const C& coupling,
          Solver solver = Solver::exact) noexcept
      : params_{law, point, inward_normal, coupling}, solver_(solver) {
    reset();
  }
  Proxy3d(const L& law, const Vector& point, const Vector& inward_normal, const BasicCoupling<Scalar>& coupling,
          Scalar period, Solver solver = Solver::exact) noexcept
      : Proxy3d(law, point, inward_normal, C(coupling, period), solver) {}

  /// Forgets all motion. A proxy that starts inside stays barred until it has been outside, in front.
  void reset() noexcept { set_state({}); }

  /// One tick: p (m), the device's position, and the needle's unit direction give the force on the device (N). K06 (41). A p or an
  /// axis that is not finite gives NaN, and the proxy is as if that tick had not been.
  Vector step(const Vector& p, const Vector& axis) noexcept {
    if (!is_place(p) || !axis.allFinite()) return Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    return step_finite(p, axis);
  }
  /// Whether another proxy is at the same membrane.
  bool same_place(const Proxy3d& other) const noexcept {
    return params_.a == other.params_.a && params_.n == other.params_.n;
  }
  /// Goes on from where another proxy at the same membrane is, under its own law and coupling.
  void resume(const Proxy3d& previous) noexcept {
    state_ = previous.state_;
    tick_ = previous.tick_;
    if (inside(state_.phase)) lay_out(params_, state_);
  }

  /// All that the next tick depends on: a copy of it, given back, goes on to the same bits.
  const State& state() const noexcept { return state_; }
  void set_state(const State& state) noexcept {
    state_ = state;
    tick_ = {};  // until the next step
    tick_.phase = state.phase;
  }
  static void archive(auto& self, auto& state) {
    State::archive(self.state_, state);
    SpaceTick<Scalar>::archive(self.tick_, state);
    if constexpr (std::remove_reference_t<decltype(state)>::reading)
      if (inside(self.state_.phase)) lay_out(self.params_, self.state_);
  }
  void describe(auto& parameters) const {
    params_.describe(parameters);
    parameters.choice(solver_, solver_);
  }

  const Params& params() const noexcept { return params_; }
  Solver solver() const noexcept { return solver_; }
  const SpaceTick<Scalar>& tick() const noexcept { return tick_; }  ///< what the last step gave
  const L& law() const noexcept { return params_.law; }
  const Vector& force() const noexcept { return state_.f; }          ///< f(k), N
  const Vector& offset() const noexcept { return state_.e; }         ///< e(k) = q(k) - p(k), m
  Vector position() const noexcept { return state_.p + state_.e; }   ///< q(k), m
  const Vector& direction() const noexcept { return state_.b; }      ///< b, held from entry on
  Scalar axial_force() const noexcept { return tick_.axial_force; }  ///< b.f(k), N
  Phase phase() const noexcept { return state_.phase; }
  const Band<Scalar>& band() const noexcept { return tick_.band; }  ///< bounds the axial force, N
  Scalar depth() const noexcept { return tick_.depth; }             ///< m, see SpaceTick

 private:
  template <ObliqueLaw, typename, typename>
  friend class InsertionOf;  // which checks p and axis once for all membranes

  /// A tick at a place and along an axis that were checked.
  const Vector& step_finite(const Vector& p, const Vector& axis) noexcept {
    tick_ = solver_ == Solver::paper ? Paper::step(params_, state_, p, axis) : Exact::step(params_, state_, p, axis);
    return tick_.force;
  }

  Params params_;
  Solver solver_;
  State state_{};
  SpaceTick<Scalar> tick_{};
};

}  // namespace punctura
