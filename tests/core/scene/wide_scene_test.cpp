// Scenes with laws and a coupling beyond K06: how they are built, changed during a run, kept, scaled and followed.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "../support/allocations.hpp"
#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "punctura/lab/events/event_finder.hpp"
#include "punctura/lab/events/law_curve.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura/scene/values.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double wide_T = 1 / 1600.0;
const Vector3d wide_down(0, -1, 0);

Tissue measured_wall() {
  Tissue tissue;
  tissue.grip = GripShape::exponential;
  tissue.growth = 900;
  tissue.tip_length = 3e-3;
  tissue.tail_length = 1e-3;
  tissue.tail_floor = 0.3;
  tissue.cutting = 0.2;
  tissue.set = 0.25;
  return tissue;
}
Tissue measured_profile() {
  Tissue tissue;
  tissue.profile = {{0, 0, 0}, {1e-3, -0.4, 0.05}, {2.5e-3, -0.9, 0.1}, {4e-3, -0.2, 0.1}};
  return tissue;
}

/// A wall of K06, a wall of measured tissue and a profile behind each other, with a coupling that relaxes.
Scene wide_scene(Solver solver = Solver::exact) {
  Scene scene = paper_scene(1e-3, solver);
  scene.membranes.push_back({"tissue", paper_membrane(5e-4), {0, -3e-3, 0}, {0, -1, 0}});
  scene.membranes.back().tissue = measured_wall();
  scene.membranes.push_back({"profile", paper_membrane(1e-3), {0, -7e-3, 0}, {0, -1, 0}});
  scene.membranes.back().tissue = measured_profile();
  scene.relaxation = {{120, 0.3}, {60, 5}};
  return scene;
}

}  // namespace

TEST_CASE("a wall of K06 gives the same bits in a scene that goes beyond K06") {
  Noise noise(610);
  for (const Solver solver : {Solver::exact, Solver::paper}) {
    const Scene scene = paper_scene(5e-4, solver);
    Insertion plain = build_insertion(scene), wide = detail::wide_model_of<double>(scene);
    REQUIRE(plain.k06());
    REQUIRE(!wide.k06());
    for (double p : random_motion(noise, 4000, 8e-3, wide_T)) {
      const Vector3d a = plain.step(p * wide_down, wide_down), b = wide.step(p * wide_down, wide_down);
      REQUIRE(std::memcmp(&a, &b, sizeof a) == 0);
    }
  }
}

TEST_CASE("a scene that goes beyond K06 runs in the servo step without allocation, and goes on from a kept state") {
  for (const Solver solver : {Solver::exact, Solver::paper}) {
    ServoStep step = build(wide_scene(solver)), other = step;
    REQUIRE(!step.insertion().k06());
    Noise noise(611);
    const auto motion = random_motion(noise, 4000, 15e-3, wide_T);
    step.arm();
    std::vector<std::byte> kept;
    for (std::size_t k = 0; k < motion.size(); ++k) {
      if (k == 2000) {
        kept = save_state(step);
        REQUIRE(load_state(other, kept));
      }
      const DeviceSample sample = reading(k, -motion[k] / 4);
      const auto before = allocations();
      const Snapshot& s = step.step(sample);
      REQUIRE(allocations() == before);
      if (k >= 2000) REQUIRE(other.step(sample).model_force == s.model_force);
    }
    CHECK(step.fault() == other.fault());
  }
}

TEST_CASE("a change between a scene of K06 and one beyond it, during an insertion, does not jump at the device") {
  Scene plain = wide_scene();
  for (auto& placed : plain.membranes) placed.tissue = {};
  plain.relaxation.clear();
  Scene uncut = wide_scene();
  for (auto& placed : uncut.membranes) placed.tissue.cutting = 0;
  const std::array<Scene, 5> scenes{wide_scene(), plain, uncut, wide_scene(), plain};
  ServoStep step = build(plain, {}, {100, 100});
  step.arm();
  std::uint64_t k = 0;
  double y = 2e-3, before = 0;
  const auto tick = [&](double to, double most) {
    y = to;
    const Snapshot& s = step.step(reading(k++, y));
    REQUIRE(std::abs(s.force[1] - before) < most);
    before = s.force[1];
    return s;
  };
  while (y > -9e-3) tick(y - 10e-3 * wide_T, 1);
  for (const Scene& scene : scenes) {
    for (int i = 0; i < 400; ++i) tick(y, 0.05);
    ServoStep next = build(scene, {}, {100, 100});
    const auto allocated = allocations();
    next.resume(step);
    REQUIRE(allocations() == allocated);
    const Snapshot old = step.snapshot();
    step = next;
    const Snapshot now = tick(y, 0.02);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(inside(now.membranes[i].phase));
      CHECK(now.membranes[i].direction == old.membranes[i].direction);
    }
  }
}

TEST_CASE("a float runs a scene beyond K06 as a double does") {
  const Scene scene = wide_scene();
  Insertion fine = build_insertion(scene);
  InsertionF coarse = build_insertion<float>(scene);
  double worst = 0;
  for (double depth = -1e-3; depth < 14e-3; depth += 5e-3 * wide_T) {
    const Vector3d right = fine.step(depth * wide_down, wide_down);
    const auto found = coarse.step((depth * wide_down).cast<float>(), wide_down.cast<float>());
    worst = std::max(worst, (found.cast<double>() - right).maxAbs());
  }
  CHECK(worst < 2e-3);
}

TEST_CASE("each number of tissue and of the branches has a path, and a wrong one is told") {
  Scene scene = wide_scene();
  std::vector<std::string> paths;
  for_each_value(scene, [&](const std::string& path, const Field&, double&) { paths.push_back(path); });
  for (const char* path : {"coupling.relaxation[1].time_constant", "membrane[1].cutting", "membrane[0].tip_length",
                           "membrane[2].profile[3].lower", "servo.sub_steps"})
    CHECK(std::count(paths.begin(), paths.end(), path) == 1);
  CHECK(check(scene).empty());

  scene.relaxation.push_back({1, 1});
  scene.relaxation[0].time_constant = 0;
  scene.membranes[1].tissue.set = 1.5;
  scene.membranes[2].tissue.profile[1] = {1e-3, 1, 2};
  scene.servo.sub_steps = 2.5;
  std::vector<std::string> found;
  for (const Problem& p : check(scene)) found.push_back(p.path);
  for (const char* path : {"coupling.relaxation", "coupling.relaxation[0].time_constant", "servo.sub_steps",
                           "membrane[1].set", "membrane[2].profile[1].lower"})
    CHECK(std::count(found.begin(), found.end(), path) == 1);

  Scene steep = paper_scene();
  steep.membranes[0].tissue.grip = GripShape::exponential;
  steep.membranes[0].tissue.growth = 1e6;
  REQUIRE(check(steep).size() == 1);
  CHECK(check(steep)[0].path == "membrane[0].growth");
  steep.servo.rate = 0;  // a problem elsewhere does not hide it
  REQUIRE(check(steep).size() == 2);
  CHECK(check(steep)[1].path == "membrane[0].growth");
}

TEST_CASE(
    "a pop in a wall with a tail is at the depth where the slanted face is through, and its size is to the shaft") {
  Scene scene = paper_scene(5e-4);
  scene.servo.low_pass = 0;
  scene.membranes[0].tissue = measured_wall();
  scene.membranes[0].tissue.set = 0;
  Insertion insertion = build_insertion(scene);
  EventFinder finder(scene);
  std::vector<Event> found;
  double largest = 0, last = 0;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    const Vector3d tip = (-1e-3 + 5e-3 * static_cast<double>(k) * wide_T) * wide_down;
    last = insertion.step(tip, wide_down).y();
    largest = std::max(largest, last);
    MembraneRecord record = record_of(insertion.tick(0));
    for (const Event& e : finder.step(EventTick{k, static_cast<double>(k) * wide_T, {0, -1, 0}, 0, {&record, 1}}))
      found.push_back(e);
  }
  REQUIRE(found.size() == 2);
  CHECK(found[1].what == EventKind::pop);
  CHECK(found[1].depth >= 3.5e-3);
  CHECK(found[1].depth < 3.8e-3);
  CHECK(found[1].force_before == doctest::Approx(largest));
  CHECK(found[1].force_after == doctest::Approx(last).epsilon(1e-6));
  const TissueLaw law(scene.needle, scene.membranes[0].membrane, scene.membranes[0].tissue);
  const Crossing c = crossing(law, scene.needle, 5e-4, 1);
  CHECK(c.through == 3.5e-3);
  CHECK(c.settled == doctest::Approx(4.5e-3));
  CHECK(c.peak < c.through);
  const LawCurve curve = law_curve(law.pieces());
  CHECK(*std::min_element(curve.lower.begin(), curve.lower.end()) == doctest::Approx(-largest).epsilon(0.01));
}
