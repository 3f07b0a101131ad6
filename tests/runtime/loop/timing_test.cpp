#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "punctura_runtime/loop/histogram.hpp"
#include "punctura_runtime/loop/pacer.hpp"

using namespace punctura;

namespace {
/// A clock that advances only by sleeps on it or by the test.
struct FakeClock {
  struct State {
    std::int64_t now = 1000;
    std::vector<std::int64_t> woken;
  };
  State* state;
  std::int64_t now() const noexcept { return state->now; }
  void sleep_until(std::int64_t time) const noexcept {
    state->now = time;
    state->woken.push_back(time);
  }
};
}  // namespace

TEST_CASE("ticks come at absolute times: a late tick does not delay the next ones") {
  FakeClock::State state;
  Pacer<FakeClock> pacer(1600, {&state});
  for (int k = 1; k <= 1600; ++k) {
    CHECK(pacer.wait() == 0);
    if (k == 800) state.now += 400000;  // this tick's work took 0.4 of the next period
  }
  CHECK(state.now == 1000 + 1'000'000'000);
}

TEST_CASE("missed ticks are skipped and counted, not made up in a burst") {
  FakeClock::State state;
  Pacer<FakeClock> pacer(1000, {&state});
  pacer.wait();
  state.now += 10'500'000;  // ten periods and a half
  const std::uint64_t missed = pacer.wait();
  CHECK(missed == 9);
  const std::int64_t now = state.now;
  CHECK(pacer.wait() == 0);
  CHECK(state.now > now);
  CHECK((state.now - 1000) % 1'000'000 == 0);
}

TEST_CASE("a rate that does not divide a second does not drift") {
  FakeClock::State state;
  Pacer<FakeClock> pacer(1700, {&state});
  for (int k = 0; k < 17000; ++k) pacer.wait();
  CHECK(std::abs(state.now - 1000 - 10'000'000'000) <= 1);
}

TEST_CASE("the bins of a histogram have no gap; each is an eighth of an octave wide") {
  for (std::size_t i = 0; i + 1 < Histogram::bins; ++i) {
    REQUIRE(Histogram::bin(Histogram::edge(i)) == i);
    REQUIRE(Histogram::bin(Histogram::edge(i + 1) - 1) == i);
  }
}

TEST_CASE("quantiles are right to within a bin") {
  Histogram histogram;
  std::mt19937 engine(1);
  std::vector<std::int64_t> all;
  for (int i = 0; i < 100000; ++i) {
    all.push_back(static_cast<std::int64_t>(std::exp(std::normal_distribution<>(9, 1)(engine))));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (double share : {0.5, 0.9, 0.99, 0.999}) {
    const auto truth = static_cast<double>(all[static_cast<std::size_t>(share * 1e5)]);
    CHECK(static_cast<double>(Histogram::quantile(histogram.counts(), share)) == doctest::Approx(truth).epsilon(0.14));
  }
  CHECK(histogram.largest_ns() == static_cast<std::uint64_t>(all.back()));
  histogram.add(-5);
  CHECK(histogram.counts()[0] == 1);
}
