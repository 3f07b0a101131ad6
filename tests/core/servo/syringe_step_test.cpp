// A servo step with a syringe on the needle: two hands, one tick.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/paper_scene.hpp"
#include "../support/tick.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/state/archive.hpp"
#include "punctura/syringe/plunger.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double wall = 6e-3;

/// A wall that takes no liquid, thicker than the opening is long, and an open space behind it.
Scene with_syringe() {
  Scene scene = paper_scene();
  scene.membranes[0].membrane.thickness = wall;
  scene.membranes[0].outflow_behind = {5e8, 1000};
  scene.syringe = SyringeSettings{{15e-3, 4e-6, 0.3e-6, 0.5, 1e-12, 2e9}, {2000, 2}};
  return scene;
}

DeviceSample sample_at(std::uint64_t k, double depth, double thumb) {
  return {k + 1, static_cast<double>(k) * T, {0, -depth, 0}, {0, -1, 0}, 0, true, 0, thumb};
}
double depth_at(std::uint64_t k) { return -1e-3 + 5e-3 * static_cast<double>(k) * T; }

/// Pushes the needle in at 5 mm/s. A thumb pushes with 4 N once the whole opening is in tissue. Calls see(k, snapshot).
template <typename Step, typename See>
void insert(Step& step, std::uint64_t from, std::uint64_t to, double& thumb, See&& see) {
  for (std::uint64_t k = from; k < to; ++k) {
    const Snapshot& s = step.step(sample_at(k, depth_at(k), thumb));
    see(k, s);
    const double wanted = s.membranes[0].depth > tip_length(paper_needle) ? 4 : 0;
    thumb = Thumb{}.step(thumb, wanted, s.syringe.force, T);
  }
}

}  // namespace

TEST_CASE("a thumb that pushes in the tissue is stopped, and goes in when the opening reaches the space behind it") {
  auto step = build(with_syringe());
  const double opening = tip_length(paper_needle), behind = wall;
  double thumb = 0, in_tissue = 0, stands_at = 0, injected = 0;
  insert(step, 0, 6400, thumb, [&](std::uint64_t k, const Snapshot& s) {
    const double depth = s.membranes[0].depth;
    if (s.membranes[0].phase != Phase::outside && depth < behind) {
      in_tissue = s.syringe.force;
      stands_at = s.sample.thumb;
    }
    if (depth > behind + opening) injected = s.syringe.left;
    (void)k;
  });
  CHECK(in_tissue == doctest::Approx(-4).epsilon(0.1));  // the plunger holds against the whole thumb
  CHECK(thumb > stands_at + 1e-3);                       // and then gives way
  CHECK(injected > 0.1e-6);
}

TEST_CASE("a membrane that is barred resists the liquid, too") {
  auto step = build(with_syringe());  // it begins with the whole opening in the tissue
  double thumb = 0;
  for (std::uint64_t k = 2100; k < 2500; ++k) {
    step.step(sample_at(k, depth_at(2100), thumb));
    thumb = std::min(thumb + 1e-5, 2e-3);
  }
  CHECK(step.snapshot().membranes[0].phase == Phase::barred);
  CHECK(step.snapshot().syringe.pressure > 1e4);  // in open air less than 1 Pa
}

TEST_CASE("the syringe does not change the needle's force, and a scene without one records NaN") {
  Scene plain = with_syringe();
  plain.syringe.reset();
  auto with = build(with_syringe()), without = build(plain);
  double thumb = 0;
  insert(with, 0, 6400, thumb, [&](std::uint64_t k, const Snapshot& s) {
    const Snapshot& other = without.step(sample_at(k, depth_at(k), 0));
    REQUIRE(s.model_force == other.model_force);
    REQUIRE(std::isnan(other.syringe.plunger));
    REQUIRE(std::isnan(other.syringe.force));
  });
}

TEST_CASE("the order of membranes in the scene does not matter") {
  Scene first = with_syringe();
  first.membranes.push_back({"behind", paper_membrane(1e-3), {0, -3e-3, 0}, {0, -1, 0}});
  Scene second = first;
  std::swap(second.membranes[0], second.membranes[1]);
  auto a = build(first), b = build(second);
  double thumb = 0;
  insert(a, 0, 6400, thumb, [&](std::uint64_t k, const Snapshot& s) {
    REQUIRE(b.step(sample_at(k, depth_at(k), s.sample.thumb)).syringe.force == s.syringe.force);
  });
}

TEST_CASE("a saved step continues with the same bits, thumb included") {
  auto step = build(with_syringe()), again = build(with_syringe());
  double thumb = 0;
  insert(step, 0, 2000, thumb, [](std::uint64_t, const Snapshot&) {});
  REQUIRE(load_state(again, save_state(step)));
  insert(step, 2000, 6400, thumb, [&](std::uint64_t k, const Snapshot& s) {
    const Snapshot& other = again.step(sample_at(k, depth_at(k), s.sample.thumb));
    REQUIRE(other.syringe.force == s.syringe.force);
    REQUIRE(other.syringe.left == s.syringe.left);
    REQUIRE(other.model_force == s.model_force);
  });
}

TEST_CASE("a change of the scene keeps what is in the syringe, a reset fills it") {
  auto step = build(with_syringe());
  double thumb = 0;
  insert(step, 0, 6400, thumb, [](std::uint64_t, const Snapshot&) {});
  const double left = step.syringe()->plunger.left();
  REQUIRE(left > 0);
  Scene changed = with_syringe();
  changed.membranes[0].membrane.friction = 0.25;
  auto next = build(changed);
  next.resume(step);
  CHECK(next.step(sample_at(6400, depth_at(6400), thumb)).syringe.left == doctest::Approx(left).epsilon(0.01));
  changed.syringe->syringe.air = 1e-6;
  auto other = build(changed);
  other.resume(next);
  CHECK(other.syringe()->plunger.left() == 0);  // other contents: a full syringe
  next.reset();
  CHECK(next.syringe()->plunger.left() == 0);
}

TEST_CASE("a thumb without a reading is a fault, and takes all force away") {
  auto step = build(with_syringe());
  step.step(sample_at(0, -1e-3, 0));
  const Snapshot& s = step.step(sample_at(1, -1e-3, std::numeric_limits<double>::quiet_NaN()));
  CHECK(s.fault == Fault::thumb);
  CHECK(s.syringe.force == 0);
  CHECK(s.force == std::array<double, 3>{});
}

TEST_CASE("the numbers of a syringe are checked and reached by their paths") {
  Scene scene = with_syringe();
  scene.syringe->syringe.bore = -1;
  scene.syringe->thumb.stiffness = 0;
  scene.membranes[0].outflow.resistance = -1;
  const auto problems = check(scene);
  const auto has = [&](const char* path) {
    return std::any_of(problems.begin(), problems.end(), [&](const Problem& p) { return p.path == path; });
  };
  CHECK(problems.size() == 3);
  CHECK(has("syringe.bore"));
  CHECK(has("syringe.thumb_stiffness"));
  CHECK(has("membrane[0].outflow_resistance"));
}
