// A rival at the place of a membrane in space. It enters and leaves the membrane as K06's proxy does.
#pragma once

#include <limits>

#include "punctura/proxy/in_space.hpp"
#include "punctura/rivals/any_rival.hpp"

namespace punctura {

/// A rival in the place of a Proxy3d. At entry from the front it fixes b, the needle's direction, as K06 (41) does.
/// Inside it has the depth along b and the velocity along b, which is the difference of the last two positions over T.
class RivalProxy {
 public:
  using Scalar = double;
  using Vector = Vector3d;
  struct State {
    bool started = false;
    Phase phase = Phase::barred;
    Vector p{};  ///< last position, m
    Vector b{};  ///< the needle's direction at entry
    double cos_beta = 1;
  };

  /// point: a, any point of the surface, m. inward_normal: n, of length 1. period: T, s.
  RivalProxy(const AnyRival& rival, const Vector& point, const Vector& inward_normal, double period) noexcept
      : rival_(rival), a_(point), n_(inward_normal), period_(period) {
    reset();
  }

  /// Clears the state. A needle that starts inside gets no force until it has been outside, in front.
  void reset() noexcept {
    rival_.reset();
    state_ = {};
    tick_ = {};
    tick_.phase = state_.phase;
  }
  bool same_place(const RivalProxy& other) const noexcept { return a_ == other.a_ && n_ == other.n_; }
  /// Another rival than before begins with an untouched layer.
  void resume(const RivalProxy& previous) noexcept {
    rival_.visit([&]<typename Run>(Run& run) noexcept {
      const Run* old = std::get_if<Run>(&previous.rival_.kind);
      run.state = old ? old->state : Run{}.state;
    });
    state_ = previous.state_;
    tick_ = previous.tick_;
  }

  /// One tick. p: conditioned position, m. axis: the needle's unit direction. Returns the force on the device, N.
  const Vector& step_finite(const Vector& p, const Vector& axis) noexcept {
    const double along_normal = n_.dot(p - a_);
    if (along_normal <= 0)
      state_.phase = Phase::outside;
    else if (state_.phase == Phase::outside)
      enter(axis);
    const double velocity = state_.started ? state_.b.dot(p - state_.p) / period_ : 0;
    state_.p = p;
    state_.started = true;
    if (!inside(state_.phase)) {
      rival_.reset();
      tick_ = {{}, p, state_.b, 0, along_normal, {0, 0}, state_.phase};
      return tick_.force;
    }
    const double depth = along_normal / state_.cos_beta, force = -rival_.step(depth, velocity, period_);
    state_.phase = velocity > 0 ? Phase::sliding_in : velocity < 0 ? Phase::sliding_out : Phase::sticking;
    tick_ = {state_.b * force, p, state_.b, force, depth, {force, force}, state_.phase};
    return tick_.force;
  }

  static void archive(auto& self, auto& state) {
    AnyRival::archive(self.rival_, state);
    state.flag(self.state_.started);
    state.choice(self.state_.phase, Phase::barred);
    state.numbers(self.state_.p, self.state_.b, self.state_.cos_beta);
    SpaceTick<double>::archive(self.tick_, state);
    if (inside(self.state_.phase))
      state.require(self.state_.started && is_unit(self.state_.b) && self.state_.cos_beta >= grazing_cosine<double>);
  }
  void describe(auto& parameters) const {
    rival_.describe(parameters);
    parameters.numbers(a_, n_, period_);
  }

  const SpaceTick<double>& tick() const noexcept { return tick_; }  ///< its band is the force on both edges
  const State& state() const noexcept { return state_; }
  Phase phase() const noexcept { return state_.phase; }
  double depth() const noexcept { return tick_.depth; }

 private:
  void enter(const Vector& axis) noexcept {
    const double cos_beta = n_.dot(axis);
    state_.phase = cos_beta >= grazing_cosine<double> ? Phase::sticking : Phase::barred;
    if (state_.phase == Phase::barred) return;
    state_.b = axis;
    state_.cos_beta = cos_beta;
  }

  AnyRival rival_;
  Vector a_, n_;
  double period_;
  State state_{};
  SpaceTick<double> tick_{};
};

}  // namespace punctura
