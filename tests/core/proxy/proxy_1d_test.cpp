#include "punctura/proxy/proxy_1d.hpp"

#include <doctest/doctest.h>

#include "../support/cases.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"

using namespace punctura;
using namespace punctura::test;

TEST_CASE("the forces of K06 Fig. 10 are correct: peak, plateau after the pop, withdrawal") {
  const ThickLaw law(paper_needle, paper_membrane(1e-4));
  Proxy1d<ThickLaw> proxy(law, {400, 1}, T, Solver::exact);
  double lowest = 0;
  for (int k = 0; k < 3200; ++k) lowest = std::min(lowest, proxy.step(-1e-3 + 5e-3 * k * T));
  CHECK(lowest == doctest::Approx(-0.7296).epsilon(1e-3));
  CHECK(proxy.force() == doctest::Approx(-0.41024));
  double highest = -1;
  for (int k = 0; k < 3200; ++k) highest = std::max(highest, proxy.step(9e-3 - 5e-3 * k * T));
  CHECK(highest == doctest::Approx(0.41024));
}

TEST_CASE_TEMPLATE("a device at rest has a constant force, bit for bit, for a million ticks" *
                       doctest::test_suite("numbers"),
                   L, ThickLaw, ThickLawF) {
  using Scalar = typename L::Scalar;
  const L law({Scalar(1.08e-3), Scalar(0.28)}, {Scalar(570), Scalar(0.41), Scalar(0.2), Scalar(1e-4)});
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d<L> proxy(law, {Scalar(400), Scalar(1)}, Scalar(T), solver);
    for (int k = 0; k < 1600; ++k) proxy.step(Scalar(-1e-3 + 6e-3 * k * T));
    const Scalar p = Scalar(-1e-3 + 6e-3 * 1599 * T);
    for (int k = 0; k < 100; ++k) proxy.step(p);
    const Scalar held = proxy.force(), place = proxy.position();
    CHECK(held < Scalar(-0.3));
    CHECK(proxy.phase() == Phase::sticking);
    bool same = true;
    for (int k = 0; k < 1000000; ++k) same = same && proxy.step(p) == held && proxy.position() == place;
    CHECK(same);
  }
}

TEST_CASE("a proxy that sticks does not move") {
  Noise noise(20);
  long stuck = 0;
  for (int i = 0; i < cases(500); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    for (Solver solver : {Solver::paper, Solver::exact}) {
      Proxy1d<ThickLaw> proxy(law, random_coupling(noise), T, solver);
      double q = 0;
      bool first = true;
      for (double p : random_motion(noise, 400, law.constants().X + law.path_length(), T)) {
        proxy.step(p);
        if (!first && proxy.phase() == Phase::sticking) {
          REQUIRE(std::abs(proxy.position() - q) < 1e-16);
          ++stuck;
        }
        first = false;
        q = proxy.position();
      }
    }
  }
  CHECK(stuck > 0);
}

TEST_CASE("the force always lies in its band") {
  Noise noise(21);
  for (int i = 0; i < cases(500); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    for (Solver solver : {Solver::paper, Solver::exact}) {
      Proxy1d<ThickLaw> proxy(law, random_coupling(noise), T, solver);
      for (double p : random_motion(noise, 400, law.constants().X + law.path_length(), T)) {
        const double f = proxy.step(p);
        const auto band = law.band(proxy.depth());
        const double rounding = 1e-10 * (1 + std::abs(f));
        REQUIRE(f >= band.lower - rounding);
        REQUIRE(f <= band.upper + rounding);
      }
    }
  }
}

TEST_CASE("float and double agree within the precision of float during a stroke") {
  const ThickLaw law(paper_needle, paper_membrane(1e-3));
  const ThickLawF single({1.08e-3f, 0.28f}, {570.f, 0.41f, 0.2f, 1e-3f});
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d<ThickLaw> d(law, {400, 1}, T, solver);
    Proxy1d<ThickLawF> f(single, {400.f, 1.f}, static_cast<float>(T), solver);
    double worst = 0;
    for (int k = 0; k < 6400; ++k) {
      const float p = static_cast<float>(3.5e-3 - 4.5e-3 * std::cos(2 * 3.14159265 * k / 3200.0));
      worst = std::max(worst, std::abs(d.step(p) - static_cast<double>(f.step(p))));
    }
    MESSAGE("largest difference: " << worst << " N");
    CHECK(worst < 2e-3);
  }
}

TEST_CASE("reset() clears the state") {
  const ThickLaw law(paper_needle, paper_membrane(1e-3));
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d<ThickLaw> used(law, {400, 1}, T, solver), fresh(law, {400, 1}, T, solver);
    for (int k = 0; k < 1000; ++k) used.step(1e-5 * k);
    used.reset();
    for (int k = 0; k < 1000; ++k) REQUIRE(used.step(1e-3 + 1e-6 * k) == fresh.step(1e-3 + 1e-6 * k));
  }
}

TEST_CASE("the paper's solver equals K06 (33), line by line") {
  Noise noise(22);
  double worst = 0;
  for (int i = 0; i < cases(500); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    const auto [K, B] = random_coupling(noise);
    Proxy1d<ThickLaw> proxy(law, {K, B}, T, Solver::paper);
    double p_prev = 0, e = 0, f = 0;
    bool first = true;
    for (double p : random_motion(noise, 400, law.constants().X + law.path_length(), T)) {
      if (first) p_prev = p;
      first = false;
      const double q_star = p + (B * e + T * f) / (K * T + B);
      const double f_star = -(K * T + B) * (p - p_prev) / T + K * e;
      const auto [lower, upper] = law.band(q_star);
      const double expected = f_star < lower ? lower : f_star > upper ? upper : f_star;
      worst = std::max(worst, std::abs(proxy.step(p) - expected) / (1 + std::abs(expected)));
      // Each tick starts from the proxy's own state, because a gain above 1 would amplify rounding from tick to tick.
      f = proxy.force();
      e = proxy.offset();
      p_prev = p;
    }
  }
  MESSAGE("largest difference: " << worst);
  CHECK(worst < 1e-10);
}
