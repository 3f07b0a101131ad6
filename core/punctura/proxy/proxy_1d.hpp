// K06 section 3.1: one proxy on the axis of the needle.
#pragma once

#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/exact_friction.hpp"

namespace punctura {

/// The proxy of K06 Fig. 6, in one dimension: depth of the device in, force on the device out.
template <Law L>
class Proxy1d {
 public:
  using Scalar = typename L::Scalar;

  Proxy1d(const L& law, const BasicCoupling<Scalar>& coupling, Scalar period, Solver solver = Solver::exact) noexcept
      : law_(law), c_(coupling, period), solver_(solver) {}

  /// Forgets all motion: the next sample is where the device starts, at e = f = 0.
  void reset() noexcept {
    started_ = false;
    e_ = f_ = 0;
    phase_ = Phase::sticking;
  }

  /// One tick: p (m), the depth of the device, gives f (N), the force on it. K06 (33).
  Scalar step(Scalar p) noexcept {
    const Scalar p_prev = started_ ? p_ : p;
    const Scalar f_star = c_.holding_force(p, p_prev, e_);  // K06 (27)

    Friction<Scalar> friction;
    if (solver_ == Solver::paper) {
      depth_ = p + c_.B_over_D * e_ + c_.inv_g * f_;           // q*, K06 (31)
      friction = clamped_friction(law_.band(depth_), f_star);  // K06 (32)
    } else {
      friction = exact_friction(law_, p_prev + e_, f_star, c_.g);  // K06 (21)-(23)
    }

    // K06 (25) and (26) in one: a proxy that sticks (f = f*) keeps its place to the last bit.
    e_ = e_ - (p - p_prev) + c_.inv_g * (friction.force - f_star);
    p_ = p;
    f_ = friction.force;
    phase_ = friction.phase;
    started_ = true;
    if (solver_ == Solver::exact) depth_ = p + e_;
    return f_;
  }

  const L& law() const noexcept { return law_; }
  Scalar force() const noexcept { return f_; }          ///< f(k), N
  Scalar offset() const noexcept { return e_; }         ///< e(k) = q(k) - p(k), m
  Scalar position() const noexcept { return p_ + e_; }  ///< q(k), m
  Phase phase() const noexcept { return phase_; }
  /// The depth at which the band was taken, m: q(k), or q*(k) with Solver::paper.
  Scalar depth() const noexcept { return depth_; }

 private:
  L law_;
  SampledCoupling<Scalar> c_;
  Solver solver_;
  bool started_ = false;
  Scalar p_{}, e_{}, f_{}, depth_{};
  Phase phase_ = Phase::sticking;
};

}  // namespace punctura
