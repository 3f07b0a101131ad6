// Custom laws and couplings: laws with memory, with any number of pieces, relaxing couplings.
#include <doctest/doctest.h>

#include "../support/allocations.hpp"
#include "../support/cut_law.hpp"
#include "../support/given_law.hpp"
#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

static_assert(ObliqueLaw<CutLaw> && LawWithMemory<CutLaw> && !LawWithMemory<ThickLaw>);

/// K06's coupling with a parallel branch of stiffness K_m that relaxes: f_m = a (f_m + K_m (e - e_prev)), a = exp(-T
/// / tau).
struct OwnCoupling {
  using Scalar = double;
  template <typename Vector>
  struct Memory {
    Vector force{};  ///< f_m, N
  };
  SampledCoupling<double> base;
  double K_m, a;
  double g = base.g + a * K_m, inv_g = 1 / g;

  template <typename Vector>
  Vector holding_force(const Vector& p, const Vector& p_prev, const Vector& e_prev,
                       const Memory<Vector>& m) const noexcept {
    return -g * (p - p_prev) + base.K * e_prev + a * m.force;
  }
  template <typename Vector>
  Vector free_offset(const Vector& e_prev, const Memory<Vector>& m) const noexcept {
    return ((base.B / base.T + a * K_m) * e_prev - a * m.force) * inv_g;
  }
  template <typename Vector>
  void advance(Memory<Vector>& m, const Vector& e, const Vector& e_prev) const noexcept {
    m.force = a * (m.force + K_m * (e - e_prev));
  }
};
static_assert(SampledCouplingOf<OwnCoupling, double> && SampledCouplingOf<OwnCoupling, Vector3d>);
static_assert(SampledCouplingOf<SampledCoupling<double>, double> &&
              SampledCouplingOf<SampledCoupling<double>, Vector3d>);

}  // namespace

// Only the exact solver: this band jumps at the proxy's position, and (31) takes the band at a different position.
TEST_CASE("with a law with memory, the second pass has no force before the end of the hole") {
  Proxy1d line(CutLaw{}, Coupling{400, 1}, T);
  Proxy3d space(CutLaw{}, Vector3d(0, 0, 0), Vector3d(0, -1, 0), Coupling{400, 1}, T);
  const auto force_at = [&](double depth) {
    const double f = line.step(depth);
    CHECK(-space.step({0, -depth, 0}, {0, -1, 0}).y() == doctest::Approx(f).epsilon(1e-9));
    return f;
  };
  const auto move = [&](double from, double to) {
    double f = 0;
    for (int k = 0; k <= 800; ++k) f = force_at(from + (to - from) * k / 800);
    return f;
  };
  CHECK(move(-2e-3, 8e-3) == doctest::Approx(-1));
  const double cut = line.state().law.cut;
  CHECK(cut > 5e-3);
  move(8e-3, -2e-3);
  CHECK(move(-2e-3, 0.8 * cut) == 0);
  CHECK(line.state().law.cut == cut);
  CHECK(move(0.8 * cut, 12e-3) == doctest::Approx(-1));
  CHECK(space.state().law.cut > cut);
}

TEST_CASE("K06's law with 17 pieces has the same forces, bit for bit") {
  Noise noise(90);
  const LawCase c = random_law(noise, 1e-3);
  const ThickLaw law(c.needle, c.membrane);
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d own(law, Coupling{400, 1}, T, solver);
    Proxy1d table(GivenLaw<17>{with_room<17>(law.pieces())}, Coupling{400, 1}, T, solver);
    for (double p : random_motion(noise, 3000, law.constants().X + 2 * law.thickness(), T))
      REQUIRE(table.step(p) == own.step(p));
  }
}

TEST_CASE("a law may return its pieces by value or by reference, on a line and in space") {
  struct ByValue {
    using Scalar = double;
    ThickLaw law;
    ThickLaw::Pieces pieces(double cos_beta = 1) const noexcept { return law.pieces(cos_beta); }
  };
  Noise noise(91);
  const LawCase c = random_law(noise, 1e-3);
  const ThickLaw law(c.needle, c.membrane);
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d line(law, Coupling{400, 1}, T, solver);
    Proxy1d line_by_value(ByValue{law}, Coupling{400, 1}, T, solver);
    Proxy3d space(law, Vector3d(), Vector3d(0, -1, 0), Coupling{400, 1}, T, solver);
    Proxy3d space_by_value(ByValue{law}, Vector3d(), Vector3d(0, -1, 0), Coupling{400, 1}, T, solver);
    for (double p : random_motion(noise, 1000, law.constants().X + 2 * law.thickness(), T)) {
      REQUIRE(line_by_value.step(p) == line.step(p));
      REQUIRE(line_by_value.tick().band.lower == line.tick().band.lower);
      REQUIRE(space_by_value.step({0, -p, 0}, {0, -1, 0}) == space.step({0, -p, 0}, {0, -1, 0}));
    }
  }
}

TEST_CASE("friction that grows with the speed of the last tick is steady up to b = B + K T / 2, and rings above it") {
  struct Viscous {
    using Scalar = double;
    struct Memory {
      double depth, speed;
    };
    double b;  ///< N s/m
    PiecewiseBand<double, 2> pieces(double = 1, const Memory& m = {}) const noexcept {
      const double force = 0.1 + b * std::abs(m.speed);
      return {{0}, {{{}, {0, {-force}, {force}}}}};
    }
    bool advance(Memory& m, double depth, double dt) const noexcept {
      m = {depth, dt > 0 ? (depth - m.depth) / dt : 0};
      return true;
    }
  };
  const double K = 400, B = 1, most = B + K * T / 2, v = 20e-3;
  for (int i = 0; i < 8; ++i) {
    const Solver solver = i < 4 ? Solver::exact : Solver::paper;
    const double part = std::array{0.5, 0.95, 1.05, 1.5}[i % 4];
    CAPTURE(i);
    Proxy1d line(Viscous{part * most}, Coupling{K, B}, T, solver);
    Proxy3d space(Viscous{part * most}, Vector3d(), down, Coupling{K, B}, T, solver);
    double lowest = 0, highest = -10;
    for (int k = 0; k < 3200; ++k) {
      const double p = -1.003e-3 + v * k * T, f = line.step(p);  // no sample lies on the surface
      CHECK(-space.step({0, -p, 0}, down).y() == doctest::Approx(f).epsilon(1e-6));
      if (k < 2400) continue;
      lowest = std::min(lowest, f);
      highest = std::max(highest, f);
    }
    if (part < 1)
      CHECK(lowest == doctest::Approx(highest).epsilon(1e-6));
    else
      CHECK(highest - lowest > 0.1 * part * most * v);
  }
}

TEST_CASE(
    "friction that grows with the speed of its own tick is steady for any b, with the paper's solver to 1.4 N s/m") {
  struct Viscous {
    using Scalar = double;
    struct Memory {
      double last, dt;
    };
    double b, F = 0.1;  ///< N s/m, N
    PiecewiseBand<double, 4> pieces(double, const Memory& m) const noexcept {
      const double slope = m.dt > 0 ? b / m.dt : 0, reach = 5e-3, most = F + slope * reach;
      return {{0, m.last, m.last + reach},
              {{{}, {m.last, {-F}, {F, -slope}}, {m.last, {-F, -slope}, {F}}, {0, {-most}, {F}}}}};
    }
    bool advance(Memory& m, double depth, double dt) const noexcept {
      m = {std::max(depth, 0.0), dt > 0 ? dt : m.dt};
      return true;
    }
  };
  const double K = 400, B = 1, most = (B + K * T) * (B + K * T / 2) / B, v = 20e-3;  // 1.406 N s/m
  for (int i = 0; i < 8; ++i) {
    const Solver solver = i < 4 ? Solver::exact : Solver::paper;
    const double b = std::array{0.5, 0.98, 1.02, 4.0}[i % 4] * most;
    CAPTURE(i);
    Proxy1d line(Viscous{b}, Coupling{K, B}, T, solver);
    Proxy3d space(Viscous{b}, Vector3d(), down, Coupling{K, B}, T, solver);
    double lowest = 10, highest = 0;  // N, on the way in and out
    for (int k = 0; k < 6200; ++k) {
      const double p = -1.003e-3 + v * (k < 3200 ? k : 6400 - k) * T, f = line.step(p);
      CHECK(-space.step({0, -p, 0}, down).y() == doctest::Approx(f).epsilon(1e-6));
      if (k % 3200 < 2400) continue;
      lowest = std::min(lowest, std::abs(f));
      highest = std::max(highest, std::abs(f));
    }
    if (solver == Solver::exact || b < most) {
      CHECK(lowest == doctest::Approx(0.1 + b * v).epsilon(1e-6));
      CHECK(highest == doctest::Approx(0.1 + b * v).epsilon(1e-6));
    } else {
      CHECK(highest - lowest > 0.01);
    }
  }
}

TEST_CASE("with a coupling with memory, the force on a needle at rest relaxes") {
  const double tau = 0.1, K_m = 300;
  const OwnCoupling coupling{{Coupling{400, 1}, T}, K_m, std::exp(-T / tau)};
  const GivenLaw<2> grip{{{0}, {{{}, {0, {-1, 0, 0}, {1, 0, 0}}}}}};  // 1 N in both directions
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d line(grip, coupling, solver);
    Proxy3d space(grip, Vector3d(0, 0, 0), Vector3d(0, -1, 0), coupling, solver);
    const auto hold = [&](double depth, int ticks) {
      double f = 0;
      for (int k = 0; k < ticks; ++k) {
        f = line.step(depth);
        CHECK(-space.step({0, -depth, 0}, {0, -1, 0}).y() == doctest::Approx(f).epsilon(1e-9));
      }
      return f;
    };
    for (int k = 0; k <= 1600; ++k) hold(-1e-3 + 11e-3 * k / 1600, 1);
    hold(9.6e-3, 1);  // unloads; the proxy rests from here on
    const double offset = line.offset(), first = hold(9.6e-3, 160), second = hold(9.6e-3, 160),
                 last = hold(9.6e-3, 4000);
    CHECK(line.phase() == Phase::sticking);
    CHECK(line.offset() == offset);
    CHECK((second - last) / (first - last) == doctest::Approx(std::exp(-1.0)).epsilon(1e-6));
    CHECK(last == doctest::Approx(400 * offset).epsilon(1e-9));
  }
}

TEST_CASE("a relaxing coupling with branch stiffness 0 equals K06's coupling") {
  Noise noise(92);
  const ThickLaw law(paper_needle, paper_membrane(1e-3));
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d plain(law, Coupling{400, 1}, T, solver);
    Proxy1d relaxing(law, OwnCoupling{{Coupling{400, 1}, T}, 0, 0.9}, solver);
    for (double p : random_motion(noise, 3000, 8e-3, T)) {
      const double f = plain.step(p);
      REQUIRE(relaxing.step(p) == doctest::Approx(f).epsilon(1e-9));
    }
  }
}

TEST_CASE("a tick with an input that is not finite gives NaN and changes nothing") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Noise noise(94);
  const auto motion = random_motion(noise, 2000, 8e-3, T);
  const Vector3d down(0, -1, 0);
  for (Solver solver : {Solver::paper, Solver::exact}) {
    const ThickLaw law(paper_needle, paper_membrane(1e-3));
    Proxy1d line(law, Coupling{400, 1}, T, solver), clean_line = line;
    Proxy3d space(law, Vector3d(), down, Coupling{400, 1}, T, solver), clean_space = space;
    Insertion all = build_insertion(paper_scene(1e-3, solver)), clean_all = all;
    for (std::size_t k = 0; k < motion.size(); ++k) {
      const Vector3d tip = motion[k] * down;
      if (k % 7 == 0)
        for (double bad : {nan, inf, -inf}) {
          CHECK(std::isnan(line.step(bad)));
          CHECK(std::isnan(space.step({0, bad, 0}, down).x()));
          CHECK(std::isnan(space.step(tip, {bad, 0, 0}).x()));
          CHECK(std::isnan(all.step({bad, 0, 0}, down).x()));
          CHECK(std::isnan(all.step(tip, {bad, 0, 0}).x()));
        }
      REQUIRE(line.step(motion[k]) == clean_line.step(motion[k]));
      REQUIRE(space.step(tip, down) == clean_space.step(tip, down));
      REQUIRE(all.step(tip, down) == clean_all.step(tip, down));
    }
  }
}

TEST_CASE("the memory of a membrane survives a change of scene and is cleared by a reset") {
  Proxy3d first(CutLaw{}, Vector3d(), Vector3d(0, -1, 0), Coupling{400, 1}, T);
  for (int k = 0; k <= 800; ++k) first.step({0, 2e-3 - 10e-3 * k / 800, 0}, {0, -1, 0});
  const double cut = first.state().law.cut;
  CHECK(cut > 4e-3);
  Proxy3d second(CutLaw{}, Vector3d(), Vector3d(0, -1, 0), Coupling{500, 1}, T);
  second.resume(first);
  CHECK(second.state().law.cut == cut);
  Proxy3d third = second;
  third.reset();
  CHECK(third.state().law.cut == 0);
  third = second;
  for (int k = 0; k < 100; ++k) {
    const Vector3d p(0, -8e-3 - 1e-5 * k, 0);
    REQUIRE(third.step(p, {0, -1, 0}) == second.step(p, {0, -1, 0}));
  }
}

TEST_CASE("norms are correct for vectors that are zero, tiny, huge or NaN") {
  const double inf = std::numeric_limits<double>::infinity(), tiny = std::numeric_limits<double>::denorm_min();
  CHECK(Vector3d().stableNorm() == 0);
  CHECK(Vector3d().stableNormalized() == Vector3d());
  CHECK(Vector3d(3e200, 4e200, 0).stableNorm() == doctest::Approx(5e200));
  CHECK(Vector3d(tiny, 0, 0).stableNorm() == tiny);
  CHECK(Vector3d(inf, 0, 0).stableNorm() == inf);
  CHECK(std::isnan(Vector3d(std::nan(""), 0, 0).stableNorm()));
  CHECK(Vector3d(0, 3e-200, 4e-200).stableNormalized().norm() == doctest::Approx(1));
}
