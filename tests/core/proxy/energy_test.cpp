// The work of the model on the hand over a closed cycle: the sum of f(k).(p(k) - p(k-1)).
//
// A cycle begins and ends at e = 0. The coupling f = K e + B (e - e_prev) / T dissipates (backward Euler), so
// sum f.de >= 0. Friction gives sum f.dq <= 0 if the band contains 0. With dp = dq - de, sum f.dp <= 0.
// If A_O < 0, the upper edge is below 0 on the tip, and the membrane expels the needle. The work of the expulsion is
// then the upper bound.
#include <doctest/doctest.h>

#include "../support/cases.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/insertion/insertion.hpp"
#include "punctura/proxy/proxy_1d.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

struct Cycle {
  double given = 0;      ///< sum f.dp, J: the work on the hand
  double expelled = 0;   ///< the work of the law while the needle slides out on a negative upper edge, J
  double exchanged = 0;  ///< sum |f.dp|, J: the scale of rounding errors
};

/// A random closed cycle through up to three membranes at random angles. It begins and ends at rest at the same
/// position.
Cycle random_cycle(Noise& noise, Solver solver, bool expelling) {
  std::vector<MembraneSite<double>> sites;
  const Vector3d axis = random_direction(noise);
  double reach = 0;
  const auto count = 1 + static_cast<int>(3 * noise.uniform());
  while (static_cast<int>(sites.size()) < count) {
    const LawCase c = random_law(noise, 1e-4);
    const ThickLaw law(c.needle, c.membrane);
    if ((law.constants().A_O < 0) != expelling) continue;
    const Vector3d n = (axis + 0.5 * noise.uniform() * random_direction(noise)).stableNormalized();
    const double depth = 2e-3 * noise.uniform();
    sites.push_back({law, depth * axis, n});
    reach = std::max(reach, depth + law.constants().X + 2 * law.thickness());
  }
  InsertionOf<ThickLaw> insertion(sites, random_coupling(noise), T, solver);

  auto path = random_motion(noise, 1500, reach, T);
  const Vector3d home = -0.5 * reach * axis;  // in front of all membranes at all angles
  const Vector3d side = axis.cross(std::abs(axis.x()) < 0.5 ? Vector3d(1, 0, 0) : Vector3d(0, 1, 0)).stableNormalized();
  Cycle cycle;
  Vector3d p_prev = home;
  std::vector<Vector3d> q_prev(sites.size(), home);
  const auto go = [&](const Vector3d& p) {
    const Vector3d f = insertion.step(p, axis);
    const double work = f.dot(p - p_prev);
    cycle.given += work;
    cycle.exchanged += std::abs(work);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const auto& proxy = insertion.proxies()[i];
      const Vector3d q = proxy.position();
      if (proxy.phase() == Phase::sliding_out) cycle.expelled += std::max(0.0, proxy.force().dot(q - q_prev[i]));
      q_prev[i] = q;
    }
    p_prev = p;
  };
  for (int k = 0; k < 5; ++k) go(home);
  for (double x : path) go((x - 0.2 * reach) * axis + 0.02 * x * side);
  const Vector3d last = p_prev;
  for (int k = 1; k <= 400; ++k) go(last + (home - reach * axis - last) * k / 400.0);
  for (int k = 1; k <= 400; ++k) go(home - reach * axis * (400 - k) / 400.0);
  for (int k = 0; k < 200; ++k) go(home);
  return cycle;
}
}  // namespace

TEST_CASE("over a closed cycle the model does no work on the hand if A_O >= 0") {
  Noise noise(60);
  double worst = -1;
  int touched = 0;
  for (int i = 0; i < cases(1000); ++i) {
    for (Solver solver : {Solver::paper, Solver::exact}) {
      const Cycle cycle = random_cycle(noise, solver, false);
      touched += cycle.exchanged > 1e-6;
      if (cycle.exchanged > 1e-6) worst = std::max(worst, cycle.given / cycle.exchanged);
      REQUIRE(cycle.given <= 1e-10 * (cycle.exchanged + 1e-6));
    }
  }
  MESSAGE("most given out, relative to what was exchanged: " << worst << ", in " << touched
                                                             << " cycles that met tissue");
  CHECK(touched > cases(1000));  // of 2000: most cycles reach tissue
}

TEST_CASE("if A_O < 0 the membrane does at most the work that its law gives") {
  Noise noise(61);
  int gave = 0;
  for (int i = 0; i < cases(300); ++i) {
    for (Solver solver : {Solver::paper, Solver::exact}) {
      const Cycle cycle = random_cycle(noise, solver, true);
      REQUIRE(cycle.given <= cycle.expelled + 1e-10 * (cycle.exchanged + 1e-6));
      gave += cycle.given > 0;
    }
  }
  MESSAGE(gave << " cycles gave work to the hand");
  CHECK(gave > 0);
}
