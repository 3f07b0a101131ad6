// What a wall of measured tissue remembers of its needle, against a wall of slices with a memory each.
#include <doctest/doctest.h>

#include "../support/cases.hpp"
#include "../support/random_motion.hpp"
#include "../support/slices.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// A tissue with everything on; some have K06's grip, no cutting, a whole set, or no thickness.
TissueCase hole_case(Noise& noise, int i) {
  TissueCase c = random_tissue(noise);
  if (i % 3 == 0) {
    Tissue k06;
    k06.set = c.tissue.set;
    k06.cutting = c.tissue.cutting;
    c.tissue = k06;
  }
  if (i % 4 == 0) c.tissue.cutting = 0;
  if (i % 5 == 0) c.tissue.set = 1;
  if (i % 7 == 0) c.membrane.thickness = 0;
  return c;
}

/// The force of a wall, N, that the errors are compared with.
double largest_force(const TissueLaw& law) {
  double most = 0;
  const auto& pieces = law.pieces();
  for (std::size_t i = 0; i + 1 < pieces.count; ++i) most = std::max(most, -law.band(pieces.breaks[i]).lower);
  return most;
}

}  // namespace

TEST_CASE("the band of a wall with a hole is the average over slices with a memory each") {
  Noise noise(150);
  double worst = 0;
  int passed = 0;
  for (int i = 0; i < cases(300); ++i) {
    const TissueCase c = hole_case(noise, i);
    const TissueLaw law = c.law();
    const double U = c.path_length(), X = tip_length(c.needle, c.tissue), most = largest_force(law);
    Slices slices(c);
    TissueLaw::Memory hole{};
    auto before = law.pieces(std::cos(c.obliquity));
    for (int stroke = 0; stroke < 4; ++stroke) {
      const double depth = between(noise, 0.05, 1.2) * (X + U);
      slices.reach(depth);
      law.advance(hole, depth);
      if (stroke < 3) slices.leave(), law.leave(hole);
      passed += hole.made > X && hole.made < X + U;
      const auto pieces = law.pieces(std::cos(c.obliquity), hole);
      REQUIRE(std::is_sorted(pieces.breaks.begin(), pieces.breaks.end()));
      for (int j = 0; j < 40; ++j) {
        const double q = between(noise, -0.05, 1.2) * std::max(c.reach(), X + U);
        if (slices.is_front(q)) continue;
        const auto band = pieces.band(q), exact = slices.band(q);
        worst = std::max({worst, std::abs(band.lower - exact.lower) / most, std::abs(band.upper - exact.upper) / most});
        REQUIRE(band.lower <= band.upper + 1e-13 * most);
        // No work comes out of a closed way: no later crossing gives back more than an earlier one takes.
        REQUIRE(before.band(q).lower <= std::min(band.lower, band.upper) + 1e-13 * most);
      }
      before = pieces;
    }
  }
  MESSAGE("largest difference: " << worst << " of the largest force");
  CHECK(worst < 1e-10);
  CHECK(passed > cases(300) / 10);
}

TEST_CASE("in, out, and in again deeper: a sliding proxy has the force of the slices, on a line and in space") {
  Noise noise(151);
  int slid = 0;
  for (int i = 0; i < cases(60); ++i) {
    TissueCase c = hole_case(noise, i);
    c.obliquity = 0;
    const TissueLaw law = c.law();
    const double reach = c.path_length() + tip_length(c.needle, c.tissue), most = largest_force(law);
    const Coupling spring{between_log(noise, 1000, 1e4), 0.1};
    Proxy1d line(law, spring, 1e-3);
    Proxy3d space(law, Vector3d(), Vector3d(0, -1, 0), spring, 1e-3);
    Slices slices(c);
    double p = -1e-3;
    bool outside = true;
    const auto go = [&](double to) {
      for (const double step = (to > p ? 1 : -1) * reach / 300; (to - p) * step > 0;) {
        p += step;
        const double f = line.step(p), q = line.position();
        REQUIRE(-space.step({0, -p, 0}, {0, -1, 0}).y() == doctest::Approx(f).epsilon(1e-9).scale(1e-3));
        const bool slides = line.phase() == Phase::sliding_in || line.phase() == Phase::sliding_out;
        if (slides && q > 1e-9 && !slices.is_front(q) && !(c.membrane.thickness == 0)) {
          const auto exact = slices.band(q);
          const double edge = line.phase() == Phase::sliding_in ? exact.lower : exact.upper;
          REQUIRE(std::abs(f - edge) < 1e-8 * most);
          ++slid;
        }
        if (q > 0) slices.reach(q);
        if (q <= 0 && !outside) slices.leave();
        outside = q <= 0;
      }
    };
    for (int stroke = 0; stroke < 4; ++stroke) {
      go(between(noise, 0.1, 0.4 + 0.25 * stroke) * reach);
      go(-0.2 * reach - 3e-3);
    }
  }
  CHECK(slid > 100 * cases(60));
}

TEST_CASE("strokes to random depths, at all angles, take no work out of tissue that does not expel the needle") {
  Noise noise(152);
  double worst = -1;
  int held = 0, met = 0;
  for (int i = 0; held < cases(150); ++i) {
    const TissueCase c = hole_case(noise, i);
    const auto pieces = c.law().pieces();
    bool expels = false;
    for (std::size_t k = 0; k + 1 < pieces.count; ++k) expels |= pieces.band(pieces.breaks[k]).upper < 0;
    if (expels) continue;
    ++held;
    const double reach = std::min(c.path_length() + tip_length(c.needle, c.tissue), 0.05);
    const Vector3d down(0, -1, 0), b(std::sin(c.obliquity), -std::cos(c.obliquity), 0);
    for (const Solver solver : {Solver::exact, Solver::paper}) {
      Proxy3d proxy(c.law(), Vector3d(), down, random_coupling(noise), 1e-3, solver);
      const Vector3d home = -reach * b;
      Vector3d p = home;
      double given = 0, exchanged = 1e-6;
      const auto go = [&](const Vector3d& to, int ticks) {
        for (; ticks > 0; --ticks) {
          const Vector3d next = ticks == 1 ? to : p + (to - p) / ticks;
          const double work = proxy.step(next, b).dot(next - p);
          given += work;
          exchanged += std::abs(work);
          p = next;
        }
      };
      go(home, 5);
      for (int stroke = 0; stroke < 4; ++stroke) {
        go(between(noise, 0.1, 1.3) * reach * b, 100 + static_cast<int>(300 * noise.uniform()));
        go(between(noise, -0.2, 0.5) * reach * b, 200);  // out, or not quite
      }
      go(-2 * reach * b, 400);
      go(home, 100);
      go(home, 300);
      worst = std::max(worst, given / exchanged);
      REQUIRE(given <= 1e-10 * exchanged);
      met += exchanged > 2e-6;
    }
  }
  MESSAGE("most given out, relative to what was exchanged: " << worst);
  CHECK(met > held);
}
