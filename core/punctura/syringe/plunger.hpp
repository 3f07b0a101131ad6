// The plunger of a syringe under the thumb: the second hand of a loss of resistance.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/solver.hpp"
#include "punctura/syringe/contents.hpp"

namespace punctura {

/// The state of a plunger between two ticks.
template <typename Scalar>
struct PlungerState {
  bool started = false;
  Phase phase = Phase::sticking;
  Scalar home{};  ///< depth of the thumb in the first tick, m: there the plunger starts
  Scalar p{};     ///< p(k), m: depth of the thumb behind home
  Scalar e{};     ///< e(k) = q(k) - p(k), m
  Scalar f{};     ///< f(k), N, on the thumb
  Contents<Scalar> contents{};

  static void archive(auto& self, auto& state) {
    state.fields(self.started);
    state.choice(self.phase, Phase::sliding_out);
    state.fields(self.home, self.p, self.e, self.f, self.contents);
    state.require(inside(self.phase) && is_place(self.home) && is_place(self.p));
  }
};

/// A plunger that the thumb pushes, through a virtual coupling like that of a needle's proxy.
///
/// Dry friction holds the plunger against the difference between thumb and pressure. It sticks if the thumb's force
/// lies in the band -A P -+ F (A: its area). Else it slides, and the force is on the edge of the band at the pressure
/// of the same tick. Both are solved in closed form: docs/syringe.md.
template <typename Scalar_>
class BasicPlunger {
 public:
  using Scalar = Scalar_;
  using State = PlungerState<Scalar>;
  static_assert(std::is_trivially_copyable_v<State>);
  State state{};

  /// period: T, s. Check the syringe, the coupling and the period first.
  constexpr BasicPlunger(const BasicSyringe<Scalar>& syringe, const BasicCoupling<Scalar>& coupling,
                         Scalar period) noexcept
      : syringe_(syringe), coupling_(coupling, period) {
    reset();
  }

  /// The full syringe, with the thumb at rest on the plunger.
  constexpr void reset() noexcept {
    state = {};
    state.contents = {syringe_.liquid, syringe_.air};
  }

  /// One tick. depth: of the thumb, m, inwards. Where it is in the first tick, the plunger starts. Returns the force on
  /// the thumb, N: negative while it pushes.
  ///
  /// If depth is NaN or beyond 1000 km, it returns NaN and the state does not change.
  constexpr Scalar step(Scalar depth, const BasicOutlet<Scalar>& outlet) noexcept {
    if (!is_place(depth)) return std::numeric_limits<Scalar>::quiet_NaN();
    if (!state.started) state.home = depth;
    const Scalar p = depth - state.home;
    const auto& c = coupling_;
    const Scalar A = syringe_.area(), F = syringe_.friction;
    const Scalar p_prev = state.started ? state.p : p;
    const Scalar q_prev = p_prev + state.e;
    const Scalar f_star = c.holding_force(p, p_prev, state.e, {});  // holds the plunger still, as in K06 (27)

    const Room<Scalar> held{volume(q_prev), syringe_.compliance};
    Contents<Scalar> contents = filled(state.contents, syringe_, outlet, held, c.T);
    const Scalar middle = -A * contents.pressure;
    Scalar f = f_star;
    Phase phase = Phase::sticking;
    if (f_star < middle - F || f_star > middle + F) {
      const Scalar edge = f_star < middle - F ? -F : F;
      phase = f_star < middle - F ? Phase::sliding_in : Phase::sliding_out;
      // f = f* + g (q - q_prev) on the coupling and f = -A P + edge on the plunger give
      // q - q_prev = (edge - f* - A P) / g: while it slides, the pressure pushes the plunger back.
      const Room<Scalar> sliding{held.volume - A * (edge - f_star) * c.inv_g, held.growth + A * A * c.inv_g};
      contents = filled(state.contents, syringe_, outlet, sliding, c.T);
      f = -A * contents.pressure + edge;
    }
    state.e = state.e - (p - p_prev) + c.inv_g * (f - f_star);  // K06 (25) and (26) combined
    state.started = true;
    state.p = p;
    state.f = f;
    state.phase = phase;
    state.contents = contents;
    return f;
  }

  static void archive(auto& self, auto& state) { State::archive(self.state, state); }
  void describe(auto& parameters) const {
    const auto& s = syringe_;
    parameters.fields(s.bore, s.liquid, s.air, s.friction, s.compliance, s.resistance);
    coupling_.describe(parameters);
  }

  /// Whether another plunger has the same contents, barrel and coupling: then it can continue with this one's state.
  constexpr bool same_syringe(const BasicPlunger& other) const noexcept {
    const auto& a = syringe_;
    const auto& b = other.syringe_;
    return a.bore == b.bore && a.liquid == b.liquid && a.air == b.air && a.compliance == b.compliance &&
           coupling_.K == other.coupling_.K && coupling_.B == other.coupling_.B;
  }

  constexpr const BasicSyringe<Scalar>& syringe() const noexcept { return syringe_; }
  constexpr const SampledCoupling<Scalar>& coupling() const noexcept { return coupling_; }
  constexpr Scalar force() const noexcept { return state.f; }               ///< f(k), N, on the thumb
  constexpr Scalar position() const noexcept { return state.p + state.e; }  ///< q(k), m, of the plunger from its start
  constexpr Scalar pressure() const noexcept { return state.contents.pressure; }  ///< P(k), Pa
  constexpr Scalar left() const noexcept { return state.contents.left; }          ///< through the needle so far, m^3
  constexpr Phase phase() const noexcept { return state.phase; }

 private:
  /// Volume of the barrel with the plunger at q (m), without pressure, m^3. Beyond the barrel's floor it is negative:
  /// then the barrel's compliance is the stop.
  constexpr Scalar volume(Scalar q) const noexcept { return syringe_.liquid + syringe_.air - syringe_.area() * q; }

  BasicSyringe<Scalar> syringe_;
  SampledCoupling<Scalar> coupling_;
};

using Plunger = BasicPlunger<double>;

/// A thumb that wants to push with a force. It moves in while the plunger pushes back less, and yields if more.
///
/// depth += T (wanted + f) / b: a viscous finger, which gives no energy of its own beyond the wanted force. It does not
/// draw: it never goes out further than where it began, whatever pressure pushes the plunger.
template <typename Scalar>
struct BasicThumb {
  Scalar viscosity = 100;  ///< b, N s/m: 3 N too much move it by 30 mm/s

  /// The next depth, m. depth: now, m. wanted: N, 0 or more. f: the plunger's force on the thumb, N, negative if it
  /// pushes back. period: T, s.
  constexpr Scalar step(Scalar depth, Scalar wanted, Scalar f, Scalar period) const noexcept {
    return std::max(Scalar(0), depth + period * (wanted + f) / viscosity);
  }
};

using Thumb = BasicThumb<double>;

/// The largest force that a simulated thumb may want, N. Illustrative.
inline constexpr double strongest_thumb = 15;

}  // namespace punctura
