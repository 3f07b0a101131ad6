#include "punctura/proxy/exact_friction.hpp"

#include <doctest/doctest.h>

#include "../support/cases.hpp"
#include "../support/random_motion.hpp"
#include "punctura/proxy/proxy_1d.hpp"

using namespace punctura;
using namespace punctura::test;

TEST_CASE("first_root() is correct for all signs of the coefficients") {
  Noise noise(10);
  for (int i = 0; i < cases(100000); ++i) {
    const double r1 = between_log(noise, 1e-6, 1), r2 = (noise.uniform() < 0.5 ? -1 : 1) * between_log(noise, 1e-6, 1);
    // s (x - r1)(x - r2), with the sign s for which it is positive at 0
    const double s = r1 * r2 > 0 ? 1 : -1;
    const double first = r2 > 0 ? std::min(r1, r2) : r1;
    if (std::abs(r1 - r2) < 1e-3 * r1) continue;  // rounding moves nearly equal roots by sqrt(eps)
    const double x = first_root(s, -s * (r1 + r2), s * r1 * r2);
    REQUIRE(x == doctest::Approx(first).epsilon(1e-9));
  }
  CHECK(first_root(0.0, -2.0, 3.0) == 1.5);
  CHECK_FALSE(first_root(0.0, 2.0, 3.0) > 0);
  CHECK_FALSE(first_root(1.0, 0.0, 3.0) > 0);
  CHECK_FALSE(first_root(1.0, 1.0, 3.0) > 0);
}

namespace {

/// The distance of f from an edge at q, N. If the edge jumps within rounding of q, all values in the jump have
/// distance 0.
template <typename L, typename Edge>
double distance(const L& law, double q, double f, Edge edge) {
  const double a = edge(law.band(q - 1e-17)), b = edge(law.band(q)), c = edge(law.band(q + 1e-17));
  return std::max({0.0, std::min({a, b, c}) - f, f - std::max({a, b, c})});
}

/// The largest violation of K06 (21)-(23) during a motion, N, from the public state.
template <typename L>
double residual(const L& law, const BasicCoupling<double>& coupling, double T, const std::vector<double>& motion) {
  Proxy1d<L> proxy(law, coupling, T, Solver::exact);
  double worst = 0, e_prev = 0, q_prev = motion.front();
  for (double p : motion) {
    const double f = proxy.step(p), e = proxy.offset(), q = proxy.position();
    worst = std::max(worst, std::abs(coupling.stiffness * e + coupling.damping * (e - e_prev) / T - f));  // (21)
    const auto band = law.band(q);
    switch (proxy.phase()) {  // (23)
      case Phase::sliding_in:
        REQUIRE(q >= q_prev - 1e-17);
        worst = std::max(worst, distance(law, q, f, [](auto b) { return b.lower; }));
        break;
      case Phase::sliding_out:
        REQUIRE(q <= q_prev + 1e-17);
        worst = std::max(worst, distance(law, q, f, [](auto b) { return b.upper; }));
        break;
      case Phase::sticking:
        worst = std::max({worst, band.lower - f, f - band.upper});
        REQUIRE(std::abs(q - q_prev) < 1e-16);
        break;
      default: FAIL("a 1-D proxy is always on its line");
    }
    e_prev = e;
    q_prev = q;
  }
  return worst;
}

}  // namespace

TEST_CASE("the exact solver solves (21)-(23) without a residual") {
  Noise noise(11);
  double worst = 0;
  for (int i = 0; i < cases(2000); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    const double T = 1 / between_log(noise, 500, 8000);
    const double reach = law.constants().X + law.path_length();
    const double r = residual(law, random_coupling(noise), T, random_motion(noise, 600, reach, T));
    // Rounding of q changes the force by the slope of the law. Permit this error, because slopes reach newtons per
    // micrometre.
    const double slope = std::max({law.constants().A_I * (law.constants().X + law.constants().Q) / law.thickness(),
                                   law.constants().F / law.thickness()});
    worst = std::max(worst, r - 4e-16 * slope * reach);
  }
  MESSAGE("largest residual: " << worst << " N");
  CHECK(worst < 1e-11);
}

TEST_CASE("the exact solver finds the first root in the direction of motion") {
  Noise noise(12);
  int pops = 0;
  for (int i = 0; i < cases(300); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    const double T = 1 / 1600.0;
    const auto coupling = random_coupling(noise);
    const SampledCoupling<double> sampled(coupling, T);
    const double reach = law.constants().X + law.path_length();
    Proxy1d<ThickLaw> proxy(law, coupling, T, Solver::exact);
    double p_prev = 0, e_prev = 0;
    bool first = true;
    for (double p : random_motion(noise, 300, reach, T)) {
      if (first) p_prev = p;
      first = false;
      const double q_prev = p_prev + e_prev, f_star = sampled.holding_force(p, p_prev, e_prev, {});
      proxy.step(p);
      const double q = proxy.position();
      const double sense = proxy.phase() == Phase::sliding_in ? 1 : proxy.phase() == Phase::sliding_out ? -1 : 0;
      if (sense != 0 && std::abs(q - q_prev) > 1e-9) {
        // Strictly in between, the coupling has not reached the edge.
        for (int j = 1; j < 40; ++j) {
          const double x = q_prev + (q - q_prev) * j / 40.0;
          const auto band = law.band(x);
          const double gap = sense * ((sense > 0 ? band.lower : band.upper) - f_star - sampled.g * (x - q_prev));
          REQUIRE(gap > -1e-9);
        }
        pops += std::abs(q - q_prev) > 0.1 * reach;
      }
      p_prev = p;
      e_prev = proxy.offset();
    }
  }
  CHECK(pops > 0);
}

TEST_CASE("at constant speed the exact force has at most one turning point") {
  int worst_paper = 0;
  for (double H = 1e-5; H < 4.1e-3; H *= 1.6) {
    for (double speed : {1e-3, 3e-3, 1e-2, 3e-2, 1e-1}) {
      for (Solver solver : {Solver::exact, Solver::paper}) {
        const ThickLaw law(paper_needle, paper_membrane(H));
        Proxy1d<ThickLaw> proxy(law, {400, 1}, 1 / 1600.0, solver);
        const auto ticks = static_cast<int>((12e-3 + H) / speed * 1600);
        double f_prev = 0, step_prev = 0;
        int turns = 0;
        for (int k = 0; k < ticks; ++k) {
          const double f = proxy.step(-1e-3 + speed * k / 1600.0), step = f - f_prev;
          if (step * step_prev < 0 && std::abs(step) > 1e-12) ++turns;
          f_prev = f;
          if (std::abs(step) > 1e-12) step_prev = step;
        }
        if (solver == Solver::exact)
          CHECK(turns <= 1);
        else
          worst_paper = std::max(worst_paper, turns);
      }
    }
  }
  MESSAGE("the paper's form turns up to " << worst_paper << " times");
  CHECK(worst_paper > 500);
}

namespace {
/// A custom law: constant Coulomb friction behind the surface.
struct CoulombLaw {
  using Scalar = double;
  explicit CoulombLaw(double friction) {
    pieces_.breaks = {0};
    pieces_.pieces[1] = {0, {-friction, 0, 0}, {friction, 0, 0}};
  }
  Band<double> band(double q) const noexcept { return pieces_.band(q); }
  const PiecewiseBand<double, 2>& pieces() const noexcept { return pieces_; }

 private:
  PiecewiseBand<double, 2> pieces_{};
};
}  // namespace

TEST_CASE("a custom law runs with both solvers") {
  const CoulombLaw law(0.5);
  Noise noise(13);
  CHECK(residual(law, {400, 1}, 1 / 1600.0, random_motion(noise, 5000, 5e-3, 1 / 1600.0)) < 1e-11);
  Proxy1d<CoulombLaw> paper(law, {400, 1}, 1 / 1600.0, Solver::paper);
  for (int k = 0; k < 4000; ++k) paper.step(1e-5 * k);
  CHECK(paper.force() == doctest::Approx(-0.5));
}
