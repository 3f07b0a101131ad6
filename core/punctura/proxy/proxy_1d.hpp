// K06 section 3.1: one proxy on the axis of the needle.
#pragma once

#include <cmath>
#include <limits>

#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"

namespace punctura {

/// The proxy of K06 Fig. 6, in one dimension: depth of the device in, force on the device out.
template <Law L, typename C = SampledCoupling<typename L::Scalar>>
class Proxy1d {
 public:
  using Scalar = typename L::Scalar;
  using Params = LineParams<L, C>;
  using State = LineState<L, C>;
  static_assert(std::is_trivially_copyable_v<State>);

  Proxy1d(const L& law, const C& coupling, Solver solver = Solver::exact) noexcept
      : params_{law, coupling}, solver_(solver) {
    reset();
  }
  Proxy1d(const L& law, const BasicCoupling<Scalar>& coupling, Scalar period, Solver solver = Solver::exact) noexcept
      : Proxy1d(law, C(coupling, period), solver) {}

  /// Forgets all motion: the next sample is where the device starts, at e = f = 0.
  void reset() noexcept { set_state({}); }

  /// One tick: p (m), the depth of the device, gives f (N), the force on it. K06 (33). A p that is no place (NaN, or beyond
  /// 1000 km) gives NaN, and the proxy is as if that tick had not been.
  Scalar step(Scalar p) noexcept {
    if (!is_place(p)) return std::numeric_limits<Scalar>::quiet_NaN();
    tick_ = solver_ == Solver::paper ? Paper::step(params_, state_, p) : Exact::step(params_, state_, p);
    return tick_.force;
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
    LineTick<Scalar>::archive(self.tick_, state);
  }
  void describe(auto& parameters) const {
    params_.describe(parameters);
    parameters.choice(solver_, solver_);
  }

  const Params& params() const noexcept { return params_; }
  Solver solver() const noexcept { return solver_; }
  const LineTick<Scalar>& tick() const noexcept { return tick_; }  ///< what the last step gave
  const L& law() const noexcept { return params_.law; }
  Scalar force() const noexcept { return state_.f; }                ///< f(k), N
  Scalar offset() const noexcept { return state_.e; }               ///< e(k) = q(k) - p(k), m
  Scalar position() const noexcept { return state_.p + state_.e; }  ///< q(k), m
  Phase phase() const noexcept { return state_.phase; }
  /// The depth at which the band was taken, m: q(k), or q*(k) with Solver::paper.
  Scalar depth() const noexcept { return tick_.depth; }

 private:
  Params params_;
  Solver solver_;
  State state_{};
  LineTick<Scalar> tick_{};
};

template <Law L>
Proxy1d(const L&, const BasicCoupling<typename L::Scalar>&, typename L::Scalar) -> Proxy1d<L>;
template <Law L>
Proxy1d(const L&, const BasicCoupling<typename L::Scalar>&, typename L::Scalar, Solver) -> Proxy1d<L>;

}  // namespace punctura
