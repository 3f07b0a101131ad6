// The live estimate: its line against a direct calculation, punctures found and not found, its state.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "punctura/lab/plant/noise.hpp"
#include "punctura/lab/trace/live_estimate.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;

namespace {

constexpr double live_period = 1 / 1600.0;
constexpr double live_noise = 4e-3;  // N

struct LiveRun {
  LiveEstimate live{};
  Noise noise{7};
  double depth = 0, scale = 1;
  int found = 0;

  /// `seconds` at a speed (m/s). force(depth, time): N, without noise.
  template <typename Force>
  void go(double seconds, double speed, Force&& force) {
    const int n = static_cast<int>(seconds / live_period);
    for (int k = 0; k < n; ++k) {
      depth += speed * live_period;
      const double measured = force(depth, k * live_period) + scale * live_noise * noise.normal();
      found += live.step(depth, measured, live_period).punctured ? 1 : 0;
    }
  }
};

}  // namespace

TEST_CASE("the recursive line is the weighted least-squares line") {
  const double memory = 1e-3, step = 2e-5;
  LiveLine line(memory, 1e-9);
  Noise noise(1);
  std::vector<double> force;
  for (int i = 0; i < 200; ++i) {
    force.push_back(0.3 + 120 * i * step + 0.01 * noise.normal());
    line.add(i == 0 ? 0 : step, force.back());
  }
  double w = 0, x = 0, xx = 0, y = 0, xy = 0;
  for (int i = 0; i < 200; ++i) {
    const double at = (i - 199) * step, weight = std::exp(at / memory), f = force[static_cast<std::size_t>(i)];
    w += weight;
    x += weight * at;
    xx += weight * at * at;
    y += weight * f;
    xy += weight * at * f;
  }
  const double slope = (w * xy - x * y) / (w * xx - x * x);
  CHECK(line.slope() == doctest::Approx(slope).epsilon(1e-4));
  CHECK(line.level() == doctest::Approx((y - slope * x) / w).epsilon(1e-4));
}

TEST_CASE("the intervals of a straight line hold the truth in 95 % of the lines") {
  const double step = 2e-5;
  int slopes = 0, levels = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    LiveLine line(1e-3, 1e-9);
    Noise noise(seed);
    for (int i = 0; i < 200; ++i) line.add(i == 0 ? 0 : step, 0.3 + 120 * i * step + 0.01 * noise.normal());
    slopes += std::abs(line.slope() - 120) <= 1.96 * line.slope_error() ? 1 : 0;
    levels += std::abs(line.level() - (0.3 + 120 * 199 * step)) <= 1.96 * line.level_error() ? 1 : 0;
  }
  CHECK(std::abs(slopes - 950) <= 25);  // 3.6 standard deviations of a count
  CHECK(std::abs(levels - 950) <= 25);
}

TEST_CASE("a sudden drop of the force is found within 4 ms, and once") {
  LiveRun run;
  const auto wall = [](double z, double) { return z < 0 ? 0 : z < 4e-3 ? 200 * z : 0.3; };
  run.depth = -2e-3;
  run.go(1.1999, 5e-3, wall);
  CHECK(run.found == 0);
  CHECK(run.live.reading().phase == LivePhase::rise);
  CHECK(run.live.reading().slope.value == doctest::Approx(200).epsilon(0.05));
  run.go(0.0041, 5e-3, wall);
  CHECK(run.found == 1);
  run.go(0.5, 5e-3, wall);
  CHECK(run.found == 1);
  CHECK(run.live.reading().phase == LivePhase::behind);
  CHECK(run.live.reading().plateau.value == doctest::Approx(0.3).epsilon(0.02));
  CHECK(run.live.reading().drop == doctest::Approx(0.5).epsilon(0.05));
  CHECK(run.live.reading().puncture_depth == doctest::Approx(4e-3).epsilon(0.02));
}

TEST_CASE("a thick wall that lets go slowly is one puncture, also with noise, a tremor or a rest within its fall") {
  const auto wall = [](double z, double) {
    return z < 0 ? 0 : z < 4e-3 ? 200 * z : std::max(0.2, 0.8 - 250 * (z - 4e-3));
  };
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const double scale : {1.0, 4.0}) {
      LiveRun run;
      LiveSettings settings;
      settings.noise = scale * live_noise;
      run.live = LiveEstimate(settings);
      run.noise = Noise(seed);
      run.scale = scale;
      run.depth = -1e-3;
      run.go(1.5, 4e-3, wall);  // 1 mm into the fall
      CHECK(run.found == 1);
      if (seed % 3 == 1) run.go(1.0, 0, [&](double z, double t) { return wall(z, 0) - 0.1 * (1 - std::exp(-4 * t)); });
      if (seed % 3 == 2) {
        const double turn = run.depth, force = wall(turn, 0);
        const auto elastic = [&](double z, double) { return force - 1000 * (turn - z); };
        run.go(0.01, -1e-2, elastic);
        run.go(0.01, 1e-2, elastic);
      }
      run.go(2.0, 4e-3, wall);
      CHECK(run.found == 1);
      CHECK(run.live.reading().drop == doctest::Approx(0.6).epsilon(0.1));
    }
  }
}

TEST_CASE("a wall within the fall of the one before it is a puncture of its own") {
  LiveRun run;
  run.go(2.5, 4e-3, [](double z, double) {
    return z < 4e-3 ? 200 * z : z < 5e-3 ? 0.8 - 250 * (z - 4e-3) : z < 6e-3 ? 0.55 + 300 * (z - 5e-3) : 0.3;
  });
  CHECK(run.found == 2);
}

TEST_CASE("a withdrawal, a relaxing hold and a wrong tick are no punctures") {
  LiveRun run;
  const auto wall = [](double z, double) { return z < 0 ? 0 : 200 * z; };
  run.go(0.6, 5e-3, wall);
  run.go(3.0, 0, [](double, double t) { return 0.3 + 0.3 * std::exp(-t); });  // a hold
  CHECK(run.found == 0);
  const double turn = run.depth;
  run.go(0.3, -5e-3, [&](double z, double) { return std::max(-0.3, 0.3 - 800 * (turn - z)); });
  CHECK(run.found == 0);
  LiveRun other;
  other.go(0.6, 5e-3, wall);
  other.live.step(other.depth + 1e-6, -2, live_period);
  other.go(0.2, 5e-3, wall);
  CHECK(other.found == 0);
}

TEST_CASE("a force without any noise: the drop ends, and the plateau is known") {
  LiveEstimate live;
  for (int k = 0; k < 1600; ++k) {
    const double depth = -1e-3 + 5e-3 * k * live_period;
    live.step(depth, depth < 0 ? 0 : depth < 2e-3 ? 200 * depth : 0.2, live_period);
  }
  CHECK(live.reading().punctures == 1);
  CHECK(live.reading().plateau.value == doctest::Approx(0.2).epsilon(1e-3));
}

TEST_CASE("two membranes: two punctures, and the slope of each") {
  LiveRun run;
  const auto walls = [](double z, double) {
    if (z < 3e-3) return std::max(0.0, 250 * z);
    if (z < 6e-3) return 0.2;
    return z < 9e-3 ? 0.2 + 400 * (z - 6e-3) : 0.5;
  };
  run.go(1.1, 4e-3, walls);
  CHECK(run.found == 1);
  CHECK(run.live.reading().plateau.value == doctest::Approx(0.2).epsilon(0.05));
  run.go(1.1, 4e-3, walls);
  CHECK(run.live.reading().slope.value == doctest::Approx(400).epsilon(0.05));
  run.go(0.4, 4e-3, walls);
  CHECK(run.found == 2);
}

TEST_CASE("a sample that is no number is left out and counted") {
  LiveEstimate live;
  live.step(0, 0.1, live_period);
  live.step(std::numeric_limits<double>::quiet_NaN(), 0.1, live_period);
  live.step(1e-3, std::numeric_limits<double>::infinity(), live_period);
  live.step(1e-3, 0.1, 0);
  CHECK(live.ignored() == 3);
  CHECK(live.reading().punctures == 0);
  live.reset();
  CHECK(live.ignored() == 0);
}

TEST_CASE("a saved live estimate continues with the same bits") {
  const auto wall = [](double z, double) { return z < 0 ? 0 : z < 4e-3 ? 200 * z : 0.3; };
  for (const double seconds : {0.1, 0.5, 0.81, 1.2}) {
    LiveRun run;
    run.go(seconds, 5e-3, wall);
    LiveEstimate copy;
    REQUIRE(load_state(copy, save_state(run.live)));
    for (int k = 0; k < 800; ++k) {
      run.depth += 5e-3 * live_period;
      const double force = wall(run.depth, 0);
      const LiveReading a = run.live.step(run.depth, force, live_period);
      const LiveReading b = copy.step(run.depth, force, live_period);
      CHECK(a.punctured == b.punctured);
      CHECK(((a.slope.value == b.slope.value) || (std::isnan(a.slope.value) && std::isnan(b.slope.value))));
      CHECK(a.drop == b.drop);
    }
  }
}
