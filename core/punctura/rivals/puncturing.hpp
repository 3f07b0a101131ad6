// Rivals that resist until the tissue is punctured, and by friction behind the puncture.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "punctura/rivals/rival.hpp"

namespace punctura {

/// Dry friction after Karnopp (1985): outside the dead band the friction is that of sliding. Inside the dead band it
/// keeps its last value, but it is never stronger than the friction of sliding.
///
/// Karnopp takes the applied force inside the dead band. A device with a commanded force does not measure it, so the
/// last value stands for it.
struct DryFriction {
  double held = 0;  ///< N

  /// in, out: friction of sliding inwards and outwards, N, both 0 or more. dead_band: m/s.
  double step(double in, double out, double velocity, double dead_band) noexcept {
    if (velocity > dead_band)
      held = in;
    else if (velocity < -dead_band)
      held = -out;
    else
      held = std::clamp(held, -out, in);
    return held;
  }

  static void archive(auto& self, auto& state) { state.fields(self.held); }
};

/// The state of a layer that resists by elasticity until it is punctured, and by friction from then on.
struct PuncturedState {
  bool punctured = false;
  DryFriction friction{};

  static void archive(auto& self, auto& state) { state.fields(self.punctured, self.friction); }
};

/// The numbers behind the puncture. Okamura et al. 2004 found friction in proportion to the inserted length. The
/// constant part stands for cutting and for the grip of a thin layer.
///
/// R derives from it and adds the elastic part.
struct BehindPuncture {
  double puncture = 5e-3;      ///< m
  double friction = 0.3;       ///< N
  double friction_slope = 10;  ///< N/m, of the inserted length
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< m/s

  template <typename R>
  static constexpr auto behind() noexcept {
    return std::array{
        RivalNumber<R>{&R::puncture, "puncture", "m", 1e-5, 0.2, "depth of the puncture below the surface"},
        RivalNumber<R>{&R::friction, "friction", "N", 0, 100, "friction behind the puncture, constant part"},
        RivalNumber<R>{&R::friction_slope, "friction_slope", "N/m", 0, 2000, "friction behind the puncture, per depth"},
        RivalNumber<R>{&R::out_ratio, "out_ratio", "-", 0, 10, "friction outwards over friction inwards",
                       Shows::withdrawal},
        RivalNumber<R>{&R::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which friction holds",
                       Shows::setting},
    };
  }

  double load(const PuncturedState&, double depth) const noexcept { return depth; }

  /// The friction behind the puncture, N. extra: further force while the needle slides in, N.
  double slide(PuncturedState& state, double depth, double velocity, double extra = 0) const noexcept {
    const double level = friction + friction_slope * depth;
    return state.friction.step(level + extra, out_ratio * level, velocity, dead_band);
  }
};

/// Elastic to the puncture, with the force R::elastic(depth, velocity), and friction alone behind it.
template <typename R>
struct ElasticToPuncture : BehindPuncture {
  using State = PuncturedState;

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    if (!state.punctured && depth < puncture) return static_cast<const R&>(*this).elastic(depth, velocity);
    state.punctured = true;
    return slide(state, depth, velocity);
  }
};

/// Joins the numbers of the elastic part and those behind the puncture.
template <typename Number, std::size_t n, std::size_t m>
constexpr std::array<Number, n + m> joined(const std::array<Number, n>& a, const std::array<Number, m>& b) noexcept {
  std::array<Number, n + m> all{};
  std::copy(a.begin(), a.end(), all.begin());
  std::copy(b.begin(), b.end(), all.begin() + n);
  return all;
}

/// f = k z + b v to the puncture, never less than 0; friction behind it. Constant k and b for a layer.
struct KelvinVoigt : ElasticToPuncture<KelvinVoigt> {
  static constexpr const char* name = "kelvin_voigt";
  static constexpr const char* title = "Kelvin-Voigt (Barbe 2007)";
  static constexpr const char* source = "Barbe et al., Int. J. Robotics Research 26(11-12), 2007";

  double stiffness = 100;  ///< k, N/m
  double damping = 0;      ///< b, N s/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<KelvinVoigt>;
    return joined(
        std::array{N{&KelvinVoigt::stiffness, "stiffness", "N/m", 0, 1e5, "k, stiffness to the puncture"},
                   N{&KelvinVoigt::damping, "damping", "N s/m", 0, 1e3, "b, damping to the puncture", Shows::speeds}},
        behind<KelvinVoigt>());
  }

  double elastic(double depth, double velocity) const noexcept {
    return std::max(0.0, stiffness * depth + damping * velocity);
  }
};
static_assert(Punctures<KelvinVoigt>);

/// f = k z^n (1 + a v) to the puncture, never less than 0; friction behind it.
struct HuntCrossley : ElasticToPuncture<HuntCrossley> {
  static constexpr const char* name = "hunt_crossley";
  static constexpr const char* title = "Hunt-Crossley";
  static constexpr const char* source =
      "Hunt, Crossley: Coefficient of restitution interpreted as damping in vibroimpact. J. Appl. Mech. 42(2), 1975";

  double peak = 1;      ///< k puncture^n: the elastic force at the puncture, N
  double exponent = 2;  ///< n
  double damping = 0;   ///< a, s/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<HuntCrossley>;
    return joined(
        std::array{
            N{&HuntCrossley::peak, "peak", "N", 0, 100, "k puncture^n, the elastic force at the puncture"},
            N{&HuntCrossley::exponent, "exponent", "-", 0.2, 8, "n, exponent of the depth"},
            N{&HuntCrossley::damping, "damping", "s/m", 0, 1000, "a, damping over elastic force", Shows::speeds}},
        behind<HuntCrossley>());
  }

  double elastic(double depth, double velocity) const noexcept {
    return peak * std::pow(depth / puncture, exponent) * std::max(0.0, 1 + damping * velocity);
  }
};
static_assert(Punctures<HuntCrossley>);

/// f = f0 (exp(b z) - 1) to the puncture, as Maurin et al. 2004 fitted it to punctures in vivo; friction behind it.
struct Exponential : ElasticToPuncture<Exponential> {
  static constexpr const char* name = "exponential";
  static constexpr const char* title = "exponential to puncture (Maurin 2004)";
  static constexpr const char* source =
      "Maurin et al.: In vivo study of forces during needle insertions. Perspective in Image-Guided Surgery, 2004";

  double scale = 0.1;   ///< f0, N
  double growth = 200;  ///< b, 1/m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Exponential>;
    return joined(std::array{N{&Exponential::scale, "scale", "N", 0, 1e3, "f0, scale of the exponential rise"},
                             N{&Exponential::growth, "growth", "1/m", 1, 5000, "b, growth of the exponential rise"}},
                  behind<Exponential>());
  }

  double elastic(double depth, double) const noexcept { return scale * std::expm1(std::min(growth * depth, 50.0)); }
};
static_assert(Punctures<Exponential>);

/// A piecewise model after Gordon et al. 2015: an exponential rise to the puncture, an exponential fall behind it, then
/// a straight line. docs/rivals.md says which part of the source we could read.
struct Gordon : BehindPuncture {
  static constexpr const char* name = "gordon";
  static constexpr const char* title = "piecewise (Gordon 2015)";
  static constexpr const char* source =
      "Gordon, Kim, Barnett, Moore: Needle insertion force model for haptic simulation. ASME MSEC2015-9352, 2015";

  double scale = 0.1;   ///< N
  double growth = 200;  ///< 1/m
  double fall = 1e-3;   ///< length of the fall behind the puncture, m

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Gordon>;
    return joined(std::array{N{&Gordon::scale, "scale", "N", 0, 1e3, "scale of the exponential rise"},
                             N{&Gordon::growth, "growth", "1/m", 1, 5000, "growth of the exponential rise"},
                             N{&Gordon::fall, "fall", "m", 1e-5, 0.05, "length of the fall behind the puncture"}},
                  behind<Gordon>());
  }

  struct State : PuncturedState {
    double peak = 0, deepest = 0;  ///< N at the puncture; m

    static void archive(auto& self, auto& state) {
      PuncturedState::archive(self, state);
      state.fields(self.peak, self.deepest);
    }
  };

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    if (!state.punctured && depth < puncture) {
      state.peak = scale * std::expm1(std::min(growth * depth, 50.0));
      return state.peak;
    }
    state.punctured = true;
    state.deepest = std::max(state.deepest, depth);
    const double above = std::max(0.0, state.peak - friction - friction_slope * puncture);
    return slide(state, depth, velocity, above * std::exp(-std::max(0.0, state.deepest - puncture) / fall));
  }
};
static_assert(Punctures<Gordon>);

/// Okamura et al. 2004: f = a1 z + a2 z^2 to the puncture. From then on a friction of (C + b |v|) z, by a Karnopp
/// model, and a constant cutting force while the tip is deeper than ever before.
struct Okamura {
  static constexpr const char* name = "okamura";
  static constexpr const char* title = "Okamura 2004";
  static constexpr const char* source =
      "Okamura, Simone, O'Leary: Force modeling for needle insertion into soft tissue. IEEE TBME 51(10), 2004";

  double linear = 50;          ///< a1, N/m
  double quadratic = 5e3;      ///< a2, N/m^2
  double puncture = 8e-3;      ///< m
  double cutting = 0.5;        ///< N
  double friction_slope = 12;  ///< C, N/m
  double viscous_slope = 0;    ///< b, N s/m^2
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< half the width of Karnopp's dead band, m/s

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<Okamura>;
    return std::array{
        N{&Okamura::linear, "linear", "N/m", 0, 1e5, "a1, linear stiffness to the puncture"},
        N{&Okamura::quadratic, "quadratic", "N/m^2", 0, 1e8, "a2, quadratic stiffness to the puncture"},
        N{&Okamura::puncture, "puncture", "m", 1e-5, 0.2, "depth of the puncture below the surface"},
        N{&Okamura::cutting, "cutting", "N", 0, 100, "cutting force while the tip is deeper than ever before"},
        N{&Okamura::friction_slope, "friction_slope", "N/m", 0, 2000, "C, friction per inserted length"},
        N{&Okamura::viscous_slope, "viscous_slope", "N s/m^2", 0, 1e5, "b, viscous friction per inserted length",
          Shows::speeds},
        N{&Okamura::out_ratio, "out_ratio", "-", 0, 10, "friction outwards over friction inwards", Shows::withdrawal},
        N{&Okamura::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which friction holds", Shows::setting},
    };
  }

  struct State {
    bool punctured = false;
    double deepest = 0;  ///< m
    DryFriction friction{};

    static void archive(auto& self, auto& state) { state.fields(self.punctured, self.deepest, self.friction); }
  };

  double load(const State&, double depth) const noexcept { return depth; }

  double resistance(State& state, double depth, double velocity, double) const noexcept {
    const bool cuts = depth >= state.deepest;
    state.deepest = std::max(state.deepest, depth);
    if (!state.punctured && depth < puncture) return (linear + quadratic * depth) * depth;
    state.punctured = true;
    const double level = friction_slope * depth, viscous = viscous_slope * depth * velocity;
    const bool slides = velocity > dead_band || velocity < -dead_band;
    const double in = level + (cuts || !slides ? cutting : 0);
    return state.friction.step(in, out_ratio * level, velocity, dead_band) + (slides ? viscous : 0);
  }
};
static_assert(Punctures<Okamura>);

/// A nonlinear Kelvin solid: f = (1 + r) g(z) at once and g(z) after a long time, with g(z) = k z^n. It breaks when the
/// stored energy reaches `puncture`. A faster needle stores more energy at the same depth, so it breaks the tissue
/// earlier. Friction behind it.
///
/// The paper compares the energy release rate of the crack with the toughness. Here the stored energy takes its place,
/// because one trace does not show the size of the crack.
struct MahvashDupont {
  static constexpr const char* name = "mahvash_dupont";
  static constexpr const char* title = "rupture (Mahvash, Dupont 2010)";
  static constexpr const char* source =
      "Mahvash, Dupont: Mechanics of dynamic needle insertion into a biological material. IEEE TBME 57(4), 2010";

  double at_1_mm = 0.05;       ///< k (1 mm)^n: the slow elastic force at a depth of 1 mm, N
  double exponent = 1.5;       ///< n
  double ratio = 0.3;          ///< r, force of the branch that relaxes over the slow force
  double relaxation = 1;       ///< s
  double puncture = 1e-3;      ///< stored energy at the rupture, J
  double friction = 0.3;       ///< N
  double friction_slope = 10;  ///< N/m
  double out_ratio = 1;        ///< friction outwards over friction inwards
  double dead_band = 0.5e-3;   ///< m/s

  static constexpr auto numbers() noexcept {
    using N = RivalNumber<MahvashDupont>;
    using M = MahvashDupont;
    return std::array{
        N{&M::at_1_mm, "at_1_mm", "N", 0, 100, "slow elastic force at a depth of 1 mm"},
        N{&M::exponent, "exponent", "-", 0.2, 8, "n, exponent of the depth"},
        N{&M::ratio, "ratio", "-", 0, 20, "r, force that relaxes over the slow force", Shows::speeds},
        N{&M::relaxation, "relaxation", "s", 0.02, 100, "relaxation time", Shows::speeds},
        N{&M::puncture, "puncture", "J", 1e-9, 10, "stored energy at the rupture"},
        N{&M::friction, "friction", "N", 0, 100, "friction behind the puncture, constant part"},
        N{&M::friction_slope, "friction_slope", "N/m", 0, 2000, "friction behind the puncture, per depth"},
        N{&M::out_ratio, "out_ratio", "-", 0, 10, "friction outwards over friction inwards", Shows::withdrawal},
        N{&M::dead_band, "dead_band", "m/s", 0, 0.1, "velocity below which friction holds", Shows::setting},
    };
  }

  struct State {
    bool punctured = false;
    double slow = 0;      ///< g at the last call, N
    double relaxing = 0;  ///< force of the branch that relaxes, N
    double depth = 0;     ///< m
    double energy = 0;    ///< stored, J
    DryFriction friction{};

    static void archive(auto& self, auto& state) {
      state.fields(self.punctured, self.slow, self.relaxing, self.depth, self.energy, self.friction);
    }
  };

  double load(const State& state, double) const noexcept { return state.energy; }

  double resistance(State& state, double depth, double velocity, double period) const noexcept {
    if (!state.punctured) {
      const double slow = at_1_mm * std::pow(depth * 1e3, exponent);
      // The Maxwell branch, exact for a force g that changes linearly over the period.
      const double x = period / relaxation, gone = -std::expm1(-x), share = x > 1e-6 ? gone / x : 1 - x / 2;
      const double relaxing = state.relaxing * (1 - gone) + ratio * (slow - state.slow) * share;
      // Stored: the integral of g, and of the branch's spring, whose stiffness is that of r g at this depth.
      const double spring = ratio * exponent * slow / std::max(depth, 1e-9);
      state.energy = slow * depth / (exponent + 1) + (spring > 0 ? relaxing * relaxing / (2 * spring) : 0);
      state.slow = slow;
      state.relaxing = relaxing;
      state.depth = depth;
      if (state.energy < puncture) return std::max(0.0, slow + relaxing);
      state.punctured = true;
    }
    const double level = friction + friction_slope * depth;
    return state.friction.step(level, out_ratio * level, velocity, dead_band);
  }
};
static_assert(Punctures<MahvashDupont>);

}  // namespace punctura
