// Proxies in a wall of measured tissue: residual, turning points, work, memory and states.
#include <doctest/doctest.h>

#include "../support/allocations.hpp"
#include "../support/cases.hpp"
#include "../support/random_motion.hpp"
#include "../support/random_tissue.hpp"
#include "punctura/model/profile_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double tissue_period = 1 / 1600.0;

/// The largest residual of (21)-(23) along a motion, N. The band is that of the memory before the tick.
double tissue_residual(const TissueLaw& law, const Coupling& spring, const std::vector<double>& motion) {
  const SampledCoupling<double> sampled(spring, tissue_period);
  Proxy1d<TissueLaw> proxy(law, spring, tissue_period);
  double worst = 0, p_prev = motion[0];
  for (const double p : motion) {
    const auto band_before = law.pieces(proxy.state().law);
    const double e_prev = proxy.offset(), q_prev = p_prev + e_prev;
    const double f = proxy.step(p), q = proxy.position();
    const double f_star = sampled.holding_force(p, p_prev, e_prev, {});
    worst = std::max(worst, std::abs(f - f_star - sampled.g * (q - q_prev)));  // (21)
    // (23): on the edge while it slides, between both sides of an edge that jumps, inside the band while it sticks.
    const std::size_t i = band_before.index(q);
    Band<double> low = band_before.piece(i).band(q), high = low;  // the least and the greatest value of each edge at q
    for (std::size_t k = i >= 3 ? i - 3 : 0; k < std::min(i + 3, band_before.last()); ++k) {
      if (std::abs(band_before.end(k) - q) > 1e-11) continue;
      for (const std::size_t side : {k, k + 1}) {
        const auto band = band_before.piece(side).band(q);
        low = {std::min(low.lower, band.lower), std::min(low.upper, band.upper)};
        high = {std::max(high.lower, band.lower), std::max(high.upper, band.upper)};
      }
    }
    worst = std::max({worst, low.lower - f, f - high.upper});
    if (proxy.phase() == Phase::sliding_in) worst = std::max(worst, f - high.lower);
    if (proxy.phase() == Phase::sliding_out) worst = std::max(worst, low.upper - f);
    p_prev = p;
  }
  return worst;
}

/// Moves the device at 5 mm/s, in steps of a tick, and rests for 0.1 s. Returns the work of the hand, J.
double tissue_stroke(Proxy1d<TissueLaw>& proxy, double from, double to) {
  double work = 0, before = from;
  const auto moves = static_cast<int>(std::abs(to - from) / 5e-3 / tissue_period);
  for (int k = 1; k <= moves + 160; ++k) {
    const double p = from + (to - from) * std::min(1.0, double(k) / moves);
    work -= proxy.step(p) * (p - before);
    before = p;
  }
  return work;
}

}  // namespace

TEST_CASE("with every addition on, the exact solver solves (21)-(23) without a residual") {
  Noise noise(140);
  double worst = 0;
  for (int i = 0; i < cases(120); ++i) {
    const TissueCase c = random_tissue(noise);
    const auto motion = random_motion(noise, 600, std::min(c.reach(), 0.05), tissue_period);
    const double rounding = 4e-16 * 10 / c.membrane.thickness * c.reach();  // of a depth, times the slope of the law
    worst = std::max(worst, tissue_residual(c.law(), random_coupling(noise), motion) - rounding);
  }
  MESSAGE("largest residual: " << worst << " N");
  CHECK(worst < 1e-11);
}

TEST_CASE("with the additions off, a proxy has the bits of K06's, also in space") {
  Noise noise(141);
  for (int i = 0; i < 6; ++i)
    for (const Solver solver : {Solver::exact, Solver::paper}) {
      const LawCase c = random_law(noise);
      const ThickLaw k06(c.needle, c.membrane);
      const TissueLaw law(c.needle, c.membrane, Tissue{});
      const Coupling spring = random_coupling(noise);
      Proxy1d one(k06, spring, tissue_period, solver);
      Proxy1d other(law, spring, tissue_period, solver);
      const Vector3d down(0, -1, 0), axis = Vector3d(0.2, -1, 0.1).stableNormalized();
      Proxy3d one_3d(k06, Vector3d(), down, spring, tissue_period, solver);
      Proxy3d other_3d(law, Vector3d(), down, spring, tissue_period, solver);
      for (const double p : random_motion(noise, 1500, k06.constants().X + k06.thickness(), tissue_period)) {
        REQUIRE(one.step(p) == other.step(p));
        REQUIRE(one.phase() == other.phase());
        REQUIRE(one_3d.step(p * axis, axis) == other_3d.step(p * axis, axis));
      }
    }
}

TEST_CASE("along the normal a wall of tissue in space is one on a line; both allocate nothing") {
  Noise noise(142);
  for (int i = 0; i < 10; ++i) {
    const TissueCase c = random_tissue(noise);
    const TissueLaw law(c.needle, c.membrane, c.tissue);
    const Coupling spring{400, 1};
    Proxy1d line(law, spring, tissue_period);
    Proxy3d space(law, Vector3d(), Vector3d(0, -1, 0), spring, tissue_period);
    const auto motion = random_motion(noise, 2000, std::min(c.reach(), 0.03), tissue_period);
    const auto before = allocations();
    for (const double p : motion) {
      const double f = line.step(p);
      REQUIRE(-space.step({0, -p, 0}, {0, -1, 0}).y() == doctest::Approx(f).epsilon(1e-9).scale(1e-3));
      REQUIRE(line.tick().band.lower <= line.force() + 1e-9);
      REQUIRE(line.force() <= line.tick().band.upper + 1e-9);
    }
    REQUIRE(allocations() == before);
    CHECK(line.state().law.cut == doctest::Approx(space.state().law.cut));
  }
}

TEST_CASE("at constant speed the force in a wall with a convex, rising profile turns at most once") {
  Noise noise(143);
  for (int i = 0; i < cases(40); ++i) {
    const Profile profile = random_convex_profile(noise);
    const ProfileLaw law(profile, between_log(noise, 1e-5, 4e-3));
    const double speed = between_log(noise, 1e-3, 0.1), end = end_of(profile) + law.thickness();
    Proxy1d proxy(law, Coupling{400, 1}, tissue_period);
    double f_prev = 0, step_prev = 0;
    int turns = 0;
    for (double p = -1e-3; p < end + 0.02; p += speed * tissue_period) {
      const double f = proxy.step(p), step = f - f_prev;
      if (step * step_prev < 0 && std::abs(step) > 1e-11) ++turns;
      f_prev = f;
      if (std::abs(step) > 1e-11) step_prev = step;
    }
    REQUIRE(turns <= 1);
  }
}

TEST_CASE("the first insertion takes the work of cutting more than the second") {
  for (const double H : {0.05e-3, 0.5e-3, 6e-3})
    for (const GripShape grip : {GripShape::linear, GripShape::exponential}) {
      TissueCase c = plain_tissue();
      c.membrane.thickness = H;
      c.tissue.grip = grip;
      c.tissue.growth = 500;
      c.tissue.cutting = 0.6;
      // A softer coupling loses more at a pop: docs/measured-tissue.md.
      Proxy1d proxy(c.law(), Coupling{20e3, 1}, tissue_period);
      const double deep = 12e-3 + H, X = tip_length(c.needle);
      const double first = tissue_stroke(proxy, -2e-3, deep), out = tissue_stroke(proxy, deep, -2e-3);
      const double second = tissue_stroke(proxy, -2e-3, deep), out_again = tissue_stroke(proxy, deep, -2e-3);
      CHECK(first - second == doctest::Approx(0.6 * X).epsilon(0.01).scale(0));
      CHECK(out == doctest::Approx(out_again).epsilon(1e-6).scale(0));
      proxy.reset();
      CHECK(tissue_stroke(proxy, -2e-3, deep) == doctest::Approx(first).epsilon(1e-6).scale(0));
    }
}

TEST_CASE("a set lowers the plateau of the second insertion, not of the first withdrawal") {
  TissueCase c = plain_tissue();
  c.tissue.set = 0.3;
  Proxy1d proxy(c.law(), Coupling{400, 1}, tissue_period);
  const auto plateau = [&](double from, double to) {
    tissue_stroke(proxy, from, to);
    return proxy.step(to + (to > from ? 1e-3 : -1e-3));
  };
  const double F = ThickLaw(c.needle, c.membrane).constants().F;
  CHECK(plateau(-2e-3, 11e-3) == doctest::Approx(-F));
  CHECK(plateau(12e-3, 8e-3) == doctest::Approx(F));
  tissue_stroke(proxy, 8e-3, -2e-3);
  CHECK(plateau(-2e-3, 11e-3) == doctest::Approx(-0.7 * F));
  CHECK(plateau(12e-3, 8e-3) == doctest::Approx(0.7 * F));
  CHECK(plateau(7e-3, 20e-3) == doctest::Approx(-0.7 * F));  // a finished hole is one at every depth
}

TEST_CASE("over a closed way, tissue that does not expel the needle gives no work to the hand") {
  Noise noise(144);
  double worst = -1;
  int held = 0;
  while (held < cases(60)) {
    const TissueCase c = random_tissue(noise);
    const TissueLaw law = c.law();
    bool expels = false;
    for (std::size_t i = 1; i < law.pieces().count; ++i) expels |= law.band(law.pieces().breaks[i - 1]).upper < 0;
    if (expels) continue;
    ++held;
    Proxy1d proxy(law, random_coupling(noise), tissue_period);
    const double reach = std::min(c.reach(), 0.03);
    auto motion = random_motion(noise, 1500, reach, tissue_period);
    const double last = motion.back(), home = motion.front();
    for (int k = 1; k <= 800; ++k) motion.push_back(last + (-reach - last) * k / 800);
    for (int k = 1; k <= 200; ++k) motion.push_back(-reach + (home + reach) * k / 200);
    double given = 0, exchanged = 1e-6, before = home;
    for (const double p : motion) {
      const double work = proxy.step(p) * (p - before);
      given += work;
      exchanged += std::abs(work);
      before = p;
    }
    worst = std::max(worst, given / exchanged);
    REQUIRE(given <= 1e-10 * exchanged);
  }
  MESSAGE("most given out, relative to what was exchanged: " << worst);
}

TEST_CASE("a saved proxy in tissue continues with the same bits; another tissue refuses the state") {
  Noise noise(145);
  for (int i = 0; i < 5; ++i) {
    TissueCase c = random_tissue(noise);
    const auto motion = random_motion(noise, 2000, std::min(c.reach(), 0.03), tissue_period);
    Proxy1d line(c.law(), Coupling{400, 1}, tissue_period), other = line;
    Proxy3d space(c.law(), Vector3d(), Vector3d(0, -1, 0), Coupling{400, 1}, tissue_period), other_space = space;
    const auto at = [&](std::size_t k) { return Vector3d(0, -motion[k], 0); };
    for (std::size_t k = 0; k < 1000; ++k) line.step(motion[k]), space.step(at(k), {0, -1, 0});
    REQUIRE(load_state(other, save_state(line)));
    REQUIRE(load_state(other_space, save_state(space)));
    for (std::size_t k = 1000; k < 2000; ++k) {
      REQUIRE(other.step(motion[k]) == line.step(motion[k]));
      REQUIRE(other_space.step(at(k), {0, -1, 0}) == space.step(at(k), {0, -1, 0}));
    }
    c.tissue.set *= 0.9;
    Proxy1d changed(c.law(), Coupling{400, 1}, tissue_period);
    CHECK(!load_state(changed, save_state(line)));
  }
}

TEST_CASE("in float, a proxy in tissue has the forces of double within the precision of float") {
  TissueCase c = plain_tissue();
  c.tissue.cutting = 0.3;
  c.tissue.set = 0.2;
  c.tissue.tip_length = 3e-3;
  const auto f = [](double x) { return static_cast<float>(x); };
  const auto& m = c.membrane;
  BasicTissue<float> tissue;
  tissue.cutting = f(c.tissue.cutting);
  tissue.set = f(c.tissue.set);
  tissue.tip_length = f(c.tissue.tip_length);
  const BasicTissueLaw<float> small({f(c.needle.diameter), f(c.needle.tip_angle)},
                                    {f(m.stiffness), f(m.precompression), f(m.friction), f(m.thickness)}, tissue);
  Proxy1d single(small, BasicCoupling<float>{400, 1}, f(tissue_period));
  Proxy1d proxy(c.law(), Coupling{400, 1}, tissue_period);
  double worst = 0;
  for (int k = 0; k < 6400; ++k) {  // in and out, twice
    const double p = 4e-3 - 5e-3 * std::cos(k * 6.283185307179586 / 3200);
    worst = std::max(worst, std::abs(proxy.step(p) - static_cast<double>(single.step(f(p)))));
  }
  MESSAGE("largest difference: " << worst << " N");
  CHECK(worst < 5e-3);
}
