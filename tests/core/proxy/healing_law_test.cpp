// A law that feels time: advance(memory, depth, dt).
#include <doctest/doctest.h>

#include <cmath>

#include "../support/cut_law.hpp"
#include "../support/healing_law.hpp"
#include "../support/tick.hpp"
#include "punctura/proxy/mixed_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

static_assert(FeelsTime<HealingLaw> && LawWithMemory<HealingLaw> && memory_is_whole<HealingLaw>);
static_assert(!FeelsTime<CutLaw> && LawWithMemory<CutLaw>);
using Heals = MixedLaw<CutLaw, HealingLaw>;
static_assert(FeelsTime<Heals> && !FeelsTime<MixedLaw<CutLaw>> && LawWithMemory<MixedLaw<CutLaw>>);

namespace {

/// The largest force of an insertion to 8 mm and back, N, and then a rest outside, s.
template <typename Tick>
double peak_of(Tick tick, double rest) {
  double peak = 0;
  for (int k = 0; k <= 1600; ++k) peak = std::max(peak, -tick(-1e-3 + 9e-3 * (1 - std::abs(k / 800.0 - 1))));
  for (int k = 0; k < rest * 1600; ++k) tick(-1e-3);
  return peak;
}

}  // namespace

TEST_CASE("the second insertion's peak grows with the time before it") {
  double last = 0;
  for (const double rest : {0.0, 0.5, 2.0, 8.0, 30.0}) {
    CAPTURE(rest);
    Proxy1d line(HealingLaw{}, Coupling{400, 1}, T);
    Proxy3d space(HealingLaw{}, Vector3d(0, 0, 0), down, Coupling{400, 1}, T);
    Proxy3d mixed(Heals(HealingLaw{}), Vector3d(0, 0, 0), down, Coupling{400, 1}, T);
    const auto on_line = [&](double depth) { return line.step(depth); };
    const auto in_space = [&](double depth) { return space.step({0, -depth, 0}, down).y() * -1; };
    const auto in_mixed = [&](double depth) { return mixed.step({0, -depth, 0}, down).y() * -1; };
    for (const double first : {peak_of(on_line, rest), peak_of(in_space, rest), peak_of(in_mixed, rest)})
      CHECK(first == doctest::Approx(1.05));
    const double second = peak_of(in_space, 0);
    CHECK(peak_of(on_line, 0) == doctest::Approx(second).epsilon(2e-3));
    CHECK(peak_of(in_mixed, 0) == second);
    const double outside = rest + 1e-3 / (9e-3 / 0.5) * 2;  // the way out and in again, and its rest
    CHECK(second - 0.05 == doctest::Approx(1 - std::exp(-outside / 2)).epsilon(0.1));
    CHECK(second > last);
    last = second;
  }
  CHECK(last > 1.04);
}

TEST_CASE("sub-steps of a law that feels time are as long as the coupling's period") {
  Proxy3d whole(HealingLaw{}, Vector3d(0, 0, 0), down, Coupling{400, 1}, T);
  Proxy3d half(HealingLaw{}, Vector3d(0, 0, 0), down, Coupling{400, 1}, T / 2);
  for (int k = 0; k < 1600; ++k) {
    whole.step({0, 1e-3, 0}, down);
    half.step({0, 1e-3, 0}, down);
    half.step({0, 1e-3, 0}, down);
  }
  CHECK(whole.state().law.healed == doctest::Approx(1 - std::exp(-0.5)).epsilon(1e-3));
  CHECK(half.state().law.healed == doctest::Approx(whole.state().law.healed).epsilon(1e-3));
}

TEST_CASE("a saved run heals on with the same bits") {
  Proxy3d a(HealingLaw{}, Vector3d(0, 0, 0), down, Coupling{400, 1}, T), b = a;
  const auto in = [](auto& proxy) { return [&](double depth) { return -proxy.step({0, -depth, 0}, down).y(); }; };
  peak_of(in(a), 1);
  REQUIRE(load_state(b, save_state(a)));
  CHECK(peak_of(in(a), 0) == peak_of(in(b), 0));
}
