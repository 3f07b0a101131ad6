// The proxy of K06 section 3.1: one proxy on the axis of the needle.
#pragma once

#include <cmath>
#include <limits>

#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"

namespace punctura {

/// The proxy of K06 Fig. 6, in one dimension. step() takes the depth of the device and returns the force on the device.
template <Law L, typename C = SampledCoupling<typename L::Scalar>>
class Proxy1d {
 public:
  using Scalar = typename L::Scalar;
  using Params = LineParams<L, C>;
  using State = LineState<L, C>;
  static_assert(std::is_trivially_copyable_v<State>);

  constexpr Proxy1d(const L& law, const C& coupling, Solver solver = Solver::exact) noexcept
      : params_{law, coupling}, solver_(solver) {
    reset();
  }
  constexpr Proxy1d(const L& law, const BasicCoupling<Scalar>& coupling, Scalar period,
                    Solver solver = Solver::exact) noexcept
      : Proxy1d(law, C(coupling, period), solver) {}

  /// Clears the state: e = f = 0, and the next sample is the first one.
  constexpr void reset() noexcept {
    state_ = {};
    depth_ = {};
    band_ = {};
  }

  /// One tick. p: depth of the device, m. Returns f, the force on the device, N. K06 (33).
  ///
  /// If p is NaN or beyond 1000 km, it returns NaN and the state does not change.
  constexpr Scalar step(Scalar p) noexcept {
    if (!is_place(p)) return std::numeric_limits<Scalar>::quiet_NaN();
    if (solver_ == Solver::paper) {
      const auto tick = Paper::step(params_, state_, p);
      depth_ = tick.depth;
      if constexpr (LawWithMemory<L>) band_ = tick.band;  // the pieces may change at the end of the step
    } else {
      Exact::step(params_, state_, p);
    }
    return state_.f;
  }

  /// The complete state of the solver, to look at. To go back to a tick later, copy the whole proxy, or use
  /// save_state() and load_state(): they also keep what tick() has beside it.
  constexpr const State& state() const noexcept { return state_; }

  static void archive(auto& self, auto& state) {
    state.fields(self.state_, self.depth_, self.band_.lower, self.band_.upper);
    if constexpr (std::remove_reference_t<decltype(state)>::reading) lay_out(self.params_, self.state_);
  }
  void describe(auto& parameters) const {
    params_.describe(parameters);
    parameters.choice(solver_, solver_);
  }

  constexpr const Params& params() const noexcept { return params_; }
  constexpr Solver solver() const noexcept { return solver_; }
  /// The result of the last step. The band is computed here, because few callers read it.
  constexpr LineTick<Scalar> tick() const noexcept { return {state_.f, position(), depth(), band(), state_.phase}; }
  constexpr const L& law() const noexcept { return params_.law; }
  constexpr Scalar force() const noexcept { return state_.f; }                ///< f(k), N, on the device
  constexpr Scalar offset() const noexcept { return state_.e; }               ///< e(k) = q(k) - p(k), m
  constexpr Scalar position() const noexcept { return state_.p + state_.e; }  ///< q(k), m
  constexpr Phase phase() const noexcept { return state_.phase; }
  /// The depth of the band, m: q(k); with Solver::paper q*(k).
  constexpr Scalar depth() const noexcept { return solver_ == Solver::paper ? depth_ : position(); }

 private:
  /// The band at depth(), N; 0 before the first step.
  constexpr Band<Scalar> band() const noexcept {
    if (!state_.started) return {};
    if constexpr (LawWithMemory<L>)
      return solver_ == Solver::paper ? band_ : state_.pieces.band(depth());
    else
      return untouched_pieces(params_.law).band(depth());
  }

  Params params_;
  Solver solver_;
  State state_{};
  // Of the last step with Solver::paper:
  Scalar depth_{};       ///< q*(k), m
  Band<Scalar> band_{};  ///< at depth_, N; only of a law with memory
};

template <Law L>
Proxy1d(const L&, const BasicCoupling<typename L::Scalar>&, typename L::Scalar) -> Proxy1d<L>;
template <Law L>
Proxy1d(const L&, const BasicCoupling<typename L::Scalar>&, typename L::Scalar, Solver) -> Proxy1d<L>;

}  // namespace punctura
