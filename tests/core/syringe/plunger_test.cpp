// The plunger fulfils its equations in every tick, gives the hand no energy, and loses its resistance where the liquid
// can leave.
#include "punctura/syringe/plunger.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "../support/cases.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double mL = 1e-6, kPa = 1e3;
constexpr Outlet closed{1e18, 0}, open{0, 0};

/// 10 mL, 15 mm wide, with the volumes of liquid and air (m^3).
Syringe syringe(double liquid, double air) { return {15e-3, liquid, air, 0.5, 1e-12, 2e9}; }
Plunger plunger(double liquid, double air) { return {syringe(liquid, air), {2000, 2}, T}; }

Syringe random_syringe(Noise& noise) {
  const double kind = noise.uniform();
  const double liquid = kind < 0.2 ? 0 : between_log(noise, 0.01, 10) * mL;
  const double air = kind > 0.8 ? 0 : between_log(noise, 0.01, 10) * mL;
  return {between_log(noise, 3e-3, 30e-3),
          liquid,
          air,
          noise.uniform() < 0.2 ? 0 : between_log(noise, 0.01, 5),
          between_log(noise, 1e-14, 1e-11),
          between_log(noise, 1e8, 1e11)};
}
Outlet random_outlet(Noise& noise, double pressure = 0) {
  return {noise.uniform() < 0.2 ? 0 : between_log(noise, 1e7, 1e15), pressure};
}

}  // namespace

TEST_CASE("each tick fulfils the balance of volumes, Boyle's law, the flow and the friction") {
  Noise noise(71);
  double worst_volume = 0, worst_force = 0;
  long stuck = 0, slid = 0, of_air = 0;
  for (int i = 0; i < cases(2000); ++i) {
    const Syringe s = random_syringe(noise);
    const Coupling coupling = random_coupling(noise);
    if (coupling.damping == 0 && coupling.stiffness == 0) continue;
    Plunger plunger(s, coupling, T);
    Outlet outlet = random_outlet(noise, 1e4 * noise.normal());
    const double g = coupling.stiffness + coupling.damping / T;
    const double scale = s.liquid + s.air, reach = scale / s.area();
    double e_prev = 0, p_prev = 0;
    bool first = true;
    for (const double x : random_motion(noise, 200, reach, T)) {
      const double p = x + 0.3 * reach;  // begins at 0
      if (noise.uniform() < 0.02) outlet = random_outlet(noise, 1e4 * noise.normal());
      const auto before = plunger.state.contents;
      const double f = plunger.step(p, outlet);
      const auto& [liquid, air, P, left] = plunger.state.contents;
      REQUIRE(liquid >= 0);
      REQUIRE(air >= 0);
      REQUIRE(P >= -atmosphere);
      // Volumes: what is in the barrel fills it. In a vacuum it may be less.
      const double V = s.liquid + s.air - s.area() * plunger.position() + s.compliance * P;
      const double y = atmosphere + P;
      const double fills = liquid + (air > 0 ? air * atmosphere / y : 0);
      const double rounding = scale + std::abs(s.area() * plunger.position()) + s.compliance * atmosphere;
      if (y > 1e-6) worst_volume = std::max(worst_volume, std::abs(fills - V) / rounding);
      // Flow, where neither content ended in this tick.
      const double R = s.resistance + outlet.resistance;
      const bool ended = (liquid == 0 && before.liquid > 0) || (air == 0 && before.air > 0);
      if (!ended && before.liquid > 0)
        REQUIRE(left - before.left == doctest::Approx(T / R * (P - outlet.pressure)).epsilon(1e-6).scale(scale * 1e-6));
      if (air < before.air) ++of_air;
      // Friction: K06's condition for the band -A P -+ F.
      const double middle = -s.area() * P, rest = 1e-9 * (1 + std::abs(f) + std::abs(middle));
      REQUIRE(f >= middle - s.friction - rest);
      REQUIRE(f <= middle + s.friction + rest);
      const double e = plunger.state.e;
      const double dq = first ? 0 : p + e - (p_prev + e_prev);
      if (plunger.phase() == Phase::sliding_in) {
        ++slid;
        REQUIRE(dq >= -1e-12 * reach);
        worst_force = std::max(worst_force, std::abs(f - (middle - s.friction)) / (1 + std::abs(f)));
      } else if (plunger.phase() == Phase::sliding_out) {
        ++slid;
        REQUIRE(dq <= 1e-12 * reach);
        worst_force = std::max(worst_force, std::abs(f - (middle + s.friction)) / (1 + std::abs(f)));
      } else {
        ++stuck;
        REQUIRE(std::abs(dq) <= 1e-15 + 1e-15 * std::abs(p));
      }
      // The coupling, K06 (21).
      if (!first)
        REQUIRE(f == doctest::Approx(coupling.stiffness * e + coupling.damping * (e - e_prev) / T)
                         .epsilon(1e-6)
                         .scale(g * 1e-9 * reach + 1e-9));
      e_prev = e;
      p_prev = p;
      first = false;
    }
  }
  MESSAGE("largest error of the volumes: " << worst_volume << ", of the force: " << worst_force);
  CHECK(worst_volume < 1e-10);
  CHECK(worst_force < 1e-12);
  CHECK(stuck > 0);
  CHECK(slid > 0);
  CHECK(of_air > 0);
}

TEST_CASE("the hand never gets more energy than it gave") {
  Noise noise(72);
  for (int i = 0; i < cases(1000); ++i) {
    const Syringe s = random_syringe(noise);
    Plunger plunger(s, random_coupling(noise), T);
    const double reach = (s.liquid + s.air) / s.area();
    double given = 0, exchanged = 0, p_prev = 0;
    bool first = true;
    Outlet outlet = random_outlet(noise);
    for (const double x : random_motion(noise, 400, reach, T)) {
      const double p = x + 0.3 * reach;
      if (noise.uniform() < 0.02) outlet = random_outlet(noise);
      const double work = plunger.step(p, outlet) * (first ? 0 : p - p_prev);
      given += work;
      exchanged += std::abs(work);
      p_prev = p;
      first = false;
      REQUIRE(given <= 1e-9 * exchanged + 1e-15);
    }
  }
}

TEST_CASE("closed air follows Boyle's law, and a held thumb feels a constant force") {
  Plunger air = plunger(0, 4 * mL);
  for (int k = 0; k < 1600; ++k) air.step(5e-3 * k * T, closed);
  double held = 0;
  for (int k = 0; k < 16000; ++k) held = air.step(5e-3, closed);
  const double V = 4 * mL - air.syringe().area() * air.position() + air.syringe().compliance * air.pressure();
  CHECK(air.pressure() + atmosphere == doctest::Approx(4 * mL * atmosphere / V));
  CHECK(held == doctest::Approx(-air.syringe().area() * air.pressure() - 0.5).epsilon(0.02));
  const double place = air.position();
  for (int k = 0; k < 1000; ++k) REQUIRE(air.step(5e-3, closed) == doctest::Approx(held));
  CHECK(air.position() == place);
}

TEST_CASE("liquid cannot be compressed, air can: 1 mm of a closed syringe") {
  Plunger liquid = plunger(4 * mL, 0), air = plunger(0, 4 * mL);
  for (int k = 0; k <= 1600; ++k) liquid.step(1e-3 * k * T, closed), air.step(1e-3 * k * T, closed);
  CHECK(liquid.position() < 0.3e-3);
  CHECK(air.position() > 0.5e-3);
  CHECK(liquid.force() < 1.2 * air.force());  // both negative
}

TEST_CASE("the resistance is lost where the liquid can leave") {
  for (const double air : {0.0, 0.3 * mL}) {
    CAPTURE(air);
    Plunger p = plunger(4 * mL, air);
    for (int k = 0; k <= 3200; ++k) p.step(std::min(3e-3, 2e-3 * k * T), {1e15, 5 * kPa});
    const double before = p.force(), left = p.left();
    CHECK(before < -3);
    CHECK(std::abs(left) < 0.001 * mL);
    for (int k = 0; k < 3200; ++k) p.step(3e-3, {5e8, 1 * kPa});  // the thumb keeps its place
    CHECK(p.force() == doctest::Approx(-p.syringe().area() * kPa - 0.5).epsilon(0.02));
    CHECK(p.left() > 0.1 * mL);
  }
}

TEST_CASE("an empty syringe pushes back at its floor, and a drawn one holds against a vacuum") {
  Plunger p = plunger(0.5 * mL, 0);
  for (int k = 0; k < 16000; ++k) p.step(std::min(10e-3, 2e-3 * k * T), open);
  CHECK(p.state.contents.liquid == 0);
  CHECK(p.left() == doctest::Approx(0.5 * mL));
  CHECK(p.position() == doctest::Approx(0.5 * mL / p.syringe().area()).epsilon(0.05));
  CHECK(p.force() == doctest::Approx(-2000 * (10e-3 - p.position())));

  p = plunger(0.5 * mL, 0);
  for (int k = 0; k < 16000; ++k) p.step(-20e-3 * k / 16000, closed);
  CHECK(p.pressure() == -atmosphere);
  CHECK(p.force() == doctest::Approx(p.syringe().area() * atmosphere + 0.5));
}

TEST_CASE("blood comes back under its pressure when the needle is in a vessel and the thumb draws") {
  Plunger p = plunger(2 * mL, 0);
  for (int k = 0; k < 3200; ++k) p.step(-3e-3 * std::min(1.0, k / 1600.0), {1e9, 1 * kPa});
  CHECK(p.left() < -0.1 * mL);
  CHECK(p.state.contents.liquid == doctest::Approx(2 * mL - p.left()));
}

TEST_CASE("a saved plunger continues with the same bits, and a number that is none changes nothing") {
  Plunger p = plunger(4 * mL, 0.2 * mL);
  for (int k = 0; k < 800; ++k) p.step(3e-3 * k * T, {1e11, 2 * kPa});
  Plunger again = plunger(4 * mL, 0.2 * mL);
  REQUIRE(load_state(again, save_state(p)));
  const double kept = p.force();
  CHECK(std::isnan(p.step(std::nan(""), open)));
  CHECK(p.force() == kept);
  for (int k = 800; k < 1600; ++k) REQUIRE(p.step(3e-3 * k * T, open) == again.step(3e-3 * k * T, open));
  Plunger other(syringe(4 * mL, 0), {2000, 2}, T);
  CHECK_FALSE(load_state(other, save_state(p)));
}

TEST_CASE("float and double agree within the precision of float") {
  const BasicSyringe<float> single{15e-3f, 4e-6f, 0.3e-6f, 0.5f, 1e-12f, 2e9f};
  Plunger d = plunger(4 * mL, 0.3 * mL);
  BasicPlunger<float> f(single, {2000.f, 2.f}, static_cast<float>(T));
  double worst = 0;
  for (int k = 0; k < 4800; ++k) {
    const auto p = static_cast<float>(3e-3 * std::sin(2e-3 * k));
    const double R = k < 2400 ? 1e15 : 5e8;
    const double a = d.step(static_cast<double>(p), {R, kPa});
    worst = std::max(worst, std::abs(a - static_cast<double>(f.step(p, {static_cast<float>(R), 1e3f}))));
  }
  MESSAGE("largest difference: " << worst << " N");
  CHECK(worst < 0.05);
}

TEST_CASE("a syringe with values that cannot be is told by field") {
  std::vector<Problem> problems;
  CHECK_FALSE(check(Syringe{-1, 0, 0, -1, 0, 0}, "syringe", problems));
  CHECK(problems.size() == 4);
  problems.clear();
  CHECK_FALSE(check(Syringe{15e-3, 0, 0, 0.5, 1e-12, 2e9}, "syringe", problems));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].reason.find("empty") != std::string::npos);
  CHECK(tube_resistance(1.1e-3, 80e-3) == doctest::Approx(2.23e9).epsilon(0.01));
}
