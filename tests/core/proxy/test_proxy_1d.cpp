// The 1-D proxy in C++: both solvers on random motions, against the equations they claim to solve.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "cases.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"

using namespace punctura;

namespace {

constexpr double T = 1 / 1600.0;
const Coupling coupling{400, 1};
const SampledCoupling<double> c(coupling, T);

/// A needle in a random membrane, and a hand that goes to and fro with a tremor.
struct Case {
  explicit Case(unsigned seed)
      : random(seed),
        law({1.08e-3, uniform(0.1, 0.6)}, {uniform(100, 2000), uniform(0, 1), uniform(0.05, 0.9), thickness()}) {}

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  double thickness() { return std::pow(10.0, uniform(-5, -2)); }
  double position(int tick) { return 6e-3 * std::sin(2 * tick * T) + uniform(-2e-5, 2e-5); }

  std::mt19937_64 random;
  ThickLaw law;
};

}  // namespace

TEST_CASE("the exact solver fulfils the coupling, the band and the direction of motion") {
  for (int seed = 0; seed < cases(200); ++seed) {
    Case one(static_cast<unsigned>(seed));
    Proxy1d proxy(one.law, coupling, T);
    double e_prev = 0, q_prev = 0;
    for (int tick = 0; tick < 4000; ++tick) {
      const double f = proxy.step(one.position(tick)), e = proxy.offset(), q = proxy.position();
      const auto band = one.law.band(q);
      const double wanted = proxy.phase() == Phase::sliding_in    ? band.lower
                            : proxy.phase() == Phase::sliding_out ? band.upper
                                                                  : f;
      if (tick > 0) {
        REQUIRE(std::abs(coupling.stiffness * e + coupling.damping * (e - e_prev) / T - f) < 1e-11);
        REQUIRE(std::abs(f - wanted) < 1e-11);
        REQUIRE(std::abs(f - band.clamp(f)) < 1e-11);
        if (proxy.phase() == Phase::sliding_in) REQUIRE(q >= q_prev);
        if (proxy.phase() == Phase::sliding_out) REQUIRE(q <= q_prev);
        if (proxy.phase() == Phase::sticking) REQUIRE(std::abs(q - q_prev) < 1e-17);
      }
      e_prev = e;
      q_prev = q;
    }
  }
}

TEST_CASE("the paper's solver is its two lines: the depth q*, then the clamp of f*") {
  for (int seed = 0; seed < cases(200); ++seed) {
    Case one(static_cast<unsigned>(seed));
    Proxy1d proxy(one.law, coupling, T, Solver::paper);
    double p_prev = 0;
    for (int tick = 0; tick < 4000; ++tick) {
      // From the proxy's own state at every tick: on a thin membrane this solver lets rounding grow.
      const double p = one.position(tick), step = tick > 0 ? p - p_prev : 0, e = proxy.offset(), f = proxy.force();
      const double D = coupling.stiffness * T + coupling.damping;
      const double f_star = -D / T * step + coupling.stiffness * e;
      const double f_new = one.law.band(p + (coupling.damping * e + T * f) / D).clamp(f_star);
      REQUIRE(std::abs(proxy.step(p) - f_new) < 1e-12);
      REQUIRE(std::abs(proxy.offset() - (coupling.damping * e + T * f_new) / D) < 1e-15);
      p_prev = p;
    }
  }
}

TEST_CASE("a still device holds a constant force") {
  Case one(1);
  Proxy1d proxy(one.law, coupling, T);
  for (int tick = 0; tick < 400; ++tick) proxy.step(1e-5 * tick);
  double force = proxy.step(4e-3);
  for (int tick = 0; tick < 4000; ++tick) force = proxy.step(4e-3);
  const double place = proxy.position();
  for (int tick = 0; tick < 4000; ++tick) CHECK(proxy.step(4e-3) == force);
  CHECK(proxy.position() == place);
  CHECK(proxy.phase() == Phase::sticking);
}
