// The force scale: how much of the model's force a device gives.
#include "punctura/servo/force_scale.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "../support/cases.hpp"
#include "../support/paper_scene.hpp"
#include "../support/tick.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
/// Its force is the place of the tip.
struct Deep {
  using Scalar = double;
  int* steps;
  Vector3d step(const Vector3d& p, const Vector3d&) noexcept { return ++*steps, p; }
};

/// A tip that waits in front until the ramp is over, and then moves in and out, deep through all walls.
double stroke_depth(std::uint64_t k) {
  return k < 1600 ? 1e-3 : 1e-3 - 8e-3 * (1 - std::cos(2e-3 * static_cast<double>(k - 1600)));
}

Vector3d force_of(const Snapshot& s) { return to_vector(s.force); }
Vector3d model_of(const Snapshot& s) { return to_vector(s.model_force); }
}  // namespace

TEST_CASE("a scale of 1 keeps every bit of the force") {
  Scene scene = three_walls();
  auto step = build(scene);
  ServoStep bare(build_insertion(scene), T);
  step.arm();
  bare.arm();
  for (std::uint64_t k = 0; k < 12000; ++k) {
    step.step(reading(k, stroke_depth(k)));
    bare.step(reading(k, stroke_depth(k)));
    REQUIRE(step.snapshot().force == bare.snapshot().force);
    if (k > 1600) REQUIRE(step.snapshot().force == step.snapshot().model_force);
  }
}

TEST_CASE("the device gets the scale's share of the force, and the model does not notice") {
  auto whole = build(three_walls()), part = build(three_walls(0.3));
  whole.arm();
  part.arm();
  double strongest = 0;
  for (std::uint64_t k = 0; k < 12000; ++k) {
    const Snapshot& a = whole.step(reading(k, stroke_depth(k)));
    const Snapshot& b = part.step(reading(k, stroke_depth(k)));
    REQUIRE(a.model_force == b.model_force);
    REQUIRE(b.force_scale == 0.3);
    if (k > 1600) REQUIRE(force_of(b) == 0.3 * model_of(b));
    strongest = std::max(strongest, force_of(b).norm());
  }
  CHECK(strongest > 0.3);
}

TEST_CASE("a scale never makes a force larger and never turns it, whatever the limits do" *
          doctest::test_suite("numbers")) {
  Noise noise(11);
  for (int run = 0; run < cases(40); ++run) {
    Scene scene = three_walls(between(noise, 0.01, 1));
    for (PlacedMembrane& placed : scene.membranes) placed.membrane.stiffness *= between_log(noise, 0.2, 20);
    auto step = build(scene, {}, {between(noise, 0.3, 4), between(noise, 0.2, 1)});
    step.arm();
    for (std::uint64_t k = 0; k < 8000; ++k) {
      const Snapshot& s = step.step(reading(k, stroke_depth(k)));
      const double most = scene.display.force_scale * model_of(s).norm();
      REQUIRE(force_of(s).norm() <= most * (1 + 1e-12));
      REQUIRE(force_of(s).norm() <= s.ceiling * (1 + 1e-12));
      REQUIRE(force_of(s).cross(model_of(s)).norm() <= 1e-12);
      REQUIRE(force_of(s).dot(model_of(s)) >= 0);
    }
  }
}

TEST_CASE("another scale while somebody holds the device fades in without a jump") {
  auto step = build(three_walls(1));
  step.arm();
  std::uint64_t k = 0;
  const auto at = [&](std::uint64_t tick) { return std::max(-5e-3, 1e-3 - 2e-6 * static_cast<double>(tick)); };
  for (; k < 4800; ++k) step.step(reading(k, at(k)));
  Snapshot before = step.snapshot();
  REQUIRE(force_of(before).norm() > 0.5);
  auto next = build(three_walls(0.25));
  next.resume(step);
  const double most = force_of(before).norm() * T / ServoStep::fade_time + 0.01;  // per tick: fade and low-pass
  for (int i = 0; i < 400; ++i, ++k) {
    const Snapshot& s = next.step(reading(k, -5e-3));
    REQUIRE((force_of(s) - force_of(before)).norm() < most);
    before = s;
  }
  CHECK((force_of(before) - 0.25 * model_of(before)).norm() < 1e-12);
}

TEST_CASE("the largest force is that of all membranes together, at the worst depth" * doctest::test_suite("numbers")) {
  Noise noise(12);
  for (int run = 0; run < cases(100); ++run) {
    Scene scene = paper_scene();
    scene.needle = {between_log(noise, 0.4e-3, 2e-3), between(noise, 0.1, 0.8)};
    scene.membranes.clear();
    double depth = 0;
    for (int i = 0; i < 1 + run % 4; ++i) {
      const double tilt = between(noise, -0.5, 0.5);
      const Membrane membrane{between_log(noise, 50, 2000), between(noise, 0, 1), between(noise, 0.02, 0.5),
                              i % 2 ? 0 : between(noise, 0, 5e-3)};
      scene.membranes.push_back({"wall", membrane, {0, -depth, 0}, {std::sin(tilt), -std::cos(tilt), 0}});
      if (i == 0) scene.membranes[0].inward_normal = {0, -1, 0};
      depth += between(noise, 0, 6e-3);
    }
    const Insertion insertion = build_insertion(scene);
    double strongest = 0;
    for (double s = -1e-3; s < 0.06; s += 2e-6) {  // along the first membrane's normal
      double in = 0, out = 0;
      for (const auto& proxy : *insertion.k06()) {
        const auto& p = proxy.params();
        const double cosine = -p.n.y();
        const auto band = p.law.pieces(cosine).band(s - (p.a.y() * p.n.y()) / cosine);
        in -= band.lower;
        out += band.upper;
      }
      strongest = std::max({strongest, in, out});
    }
    const double found = largest_force(insertion);
    CHECK(found >= strongest * (1 - 1e-12));
    CHECK(found <= strongest * 1.01);
  }
}

TEST_CASE("with the automatic scale no limit ever cuts a needle that goes straight in, however slowly" *
          doctest::test_suite("numbers")) {
  Scene scene = three_walls(1, true);
  for (PlacedMembrane& placed : scene.membranes) placed.membrane.stiffness *= 4;
  auto step = build(scene);
  REQUIRE(step.force_scale() < 0.5);
  step.arm();
  double strongest = 0;
  for (std::uint64_t k = 0; k < 64000; ++k) {  // 40 s
    const double y = std::max(-0.02, 1e-3 - 1e-3 * T * static_cast<double>(k));
    strongest = std::max(strongest, force_of(step.step(reading(k, y))).norm());
  }
  const Snapshot& s = step.snapshot();
  CHECK(s.limits.peak + s.limits.continuous == 0);
  CHECK(strongest > 0.9 * automatic_share * lasting_force({}));
  CHECK(strongest <= lasting_force({}));

  scene.display.automatic = false;
  auto without = build(scene);
  without.arm();
  for (std::uint64_t k = 0; k < 64000; ++k)
    without.step(reading(k, std::max(-0.02, 1e-3 - 1e-3 * T * static_cast<double>(k))));
  CHECK(without.snapshot().limits.peak + without.snapshot().limits.continuous > 0);
}

TEST_CASE("the automatic scale follows the limits in use, and is 1 where the device can give everything") {
  const Scene scene = three_walls(0.5, true);
  const double largest = largest_force(build_insertion(scene));
  CHECK(build(scene, {}, {100, 100}).force_scale() == 1);
  const ForceLimits weak{0.2, 0.88};
  CHECK(lasting_force(weak) == 0.2);
  CHECK(build(scene, {}, weak).force_scale() == doctest::Approx(automatic_share * 0.2 / largest));
  CHECK(lasting_force({3.3, 0.4}) == doctest::Approx(std::sqrt(0.75) * 0.4));
  CHECK(build<float>(scene, {}, weak).force_scale() == doctest::Approx(automatic_share * 0.2 / largest));
}

TEST_CASE("a model without bands is tried with at most a million steps, also on a way of a kilometre") {
  int steps = 0;
  CHECK(largest_force(Deep{&steps}, {0, 0, 0}, {0, -1, 0}, 1000, T) == 1000);
  CHECK(steps == 1'000'001);
}

TEST_CASE("check() allows a scale above 0 and up to 1") {
  for (const double bad : {0.0, -0.5, 1.001, std::numeric_limits<double>::quiet_NaN()}) {
    const auto problems = check(three_walls(bad));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].path == "display.force_scale");
  }
  for (const double good : {1e-300, 0.3, 1.0}) {
    CHECK(check(three_walls(good)).empty());
    CHECK(build<float>(three_walls(good)).force_scale() > 0);
  }
}

TEST_CASE("a saved step continues with the scaled force, and a step with another scale refuses the bytes") {
  auto step = build(three_walls(0.3));
  step.arm();
  std::uint64_t k = 0;
  for (; k < 4000; ++k) step.step(reading(k, stroke_depth(k)));
  const auto bytes = save_state(step);
  auto other = build(three_walls(0.4));
  CHECK(!load_state(other, bytes));
  auto same = build(three_walls(0.3));
  REQUIRE(load_state(same, bytes));
  for (; k < 5000; ++k) {
    step.step(reading(k, stroke_depth(k)));
    same.step(reading(k, stroke_depth(k)));
    REQUIRE(step.snapshot().force == same.snapshot().force);
  }
}
