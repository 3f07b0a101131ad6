// The coupling that relaxes: K06's coupling with Maxwell branches beside it.
#include "punctura/proxy/relaxing_coupling.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double relaxing_T = 1 / 1600.0;
constexpr std::array<MaxwellBranch, 2> two_branches{MaxwellBranch{150, 0.2}, MaxwellBranch{90, 4}};
using Relaxing = RelaxingCoupling<double>;
static_assert(SampledCouplingOf<Relaxing, double> && SampledCouplingOf<Relaxing, Vector3d>);

Scene relaxing_scene(Solver solver = Solver::exact) {
  Scene scene = paper_scene(1e-3, solver);
  scene.servo.low_pass = 0;
  scene.relaxation.assign(two_branches.begin(), two_branches.end());
  return scene;
}

}  // namespace

TEST_CASE("without branches, or with branches of stiffness 0, each bit is that of K06's coupling") {
  Noise noise(501);
  const ThickLaw law(paper_needle, paper_membrane(1e-3));
  const std::array<MaxwellBranch, 2> none{MaxwellBranch{0, 0.1}, MaxwellBranch{0, 5}};
  const Vector3d down(0, -1, 0);
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d plain(law, Coupling{400, 1}, relaxing_T, solver);
    Proxy1d<ThickLaw, Relaxing> relaxing(law, Relaxing({400, 1}, none, relaxing_T), solver);
    Proxy3d space(law, Vector3d(), down, Coupling{400, 1}, relaxing_T, solver);
    Proxy3d<ThickLaw, Relaxing> other(law, Vector3d(), down, Relaxing({400, 1}, relaxing_T), solver);
    for (double p : random_motion(noise, 3000, 8e-3, relaxing_T)) {
      const double f = plain.step(p), g = relaxing.step(p);
      REQUIRE(std::memcmp(&f, &g, sizeof f) == 0);
      const Vector3d tip = p * down, one = space.step(tip, down), two = other.step(tip, down);
      REQUIRE(std::memcmp(&one, &two, sizeof one) == 0);
    }
  }
  Scene scene = paper_scene();
  scene.relaxation.assign(none.begin(), none.end());
  CHECK(is_k06(scene));
}

TEST_CASE("the force on a needle at rest relaxes as the branches say, to 1e-9 N") {
  const ThickLaw law(paper_needle, paper_membrane(1e-3));
  const Relaxing coupling({400, 1}, two_branches, relaxing_T);
  const Vector3d down(0, -1, 0);
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d<ThickLaw, Relaxing> line(law, coupling, solver);
    Proxy3d<ThickLaw, Relaxing> space(law, Vector3d(), down, coupling, solver);
    double depth = -1e-3;
    const auto step = [&](double to) {
      depth = to;
      space.step(depth * down, down);
      return line.step(depth);
    };
    while (depth < 12e-3) step(depth + 10e-3 * relaxing_T);
    while (depth > 11.6e-3) step(depth - 10e-3 * relaxing_T);  // it unloads: the proxy rests from here on
    step(depth);
    REQUIRE(line.phase() == Phase::sticking);
    const auto start = line.state();
    REQUIRE(std::abs(start.coupling.force[0]) > 1e-3);
    double worst = 0, lost = 0;
    for (int k = 1; k <= 16000; ++k) {
      const double f = step(depth), t = k * relaxing_T;
      double expected = 400 * start.e;
      for (std::size_t i = 0; i < 2; ++i)
        expected += start.coupling.force[i] * std::exp(-t / two_branches[i].time_constant);
      worst = std::max({worst, std::abs(f - expected), std::abs(space.axial_force() - expected)});
      lost = start.f - f;
    }
    CHECK(worst < 1e-9);
    CHECK(std::abs(lost) > 0.01);
    CHECK(line.offset() == start.e);
  }
}

TEST_CASE("at a constant rate of the offset, the branches have the force of the differential equation") {
  const Relaxing coupling({400, 1}, two_branches, relaxing_T);
  Relaxing::Memory<double> memory{};
  const double rate = 5e-3;  // m/s
  double e = 0;
  for (int k = 1; k <= 3000; ++k) {
    const double before = e;
    e = rate * k * relaxing_T;
    const double expected = coupling.holding_force(0.0, 0.0, before, memory) + coupling.g * (e - before);
    coupling.advance(memory, e, before);
    double right = 400 * e + 1 * rate;
    for (const auto& [K_m, tau] : two_branches) right += K_m * tau * rate * -std::expm1(-k * relaxing_T / tau);
    REQUIRE(expected == doctest::Approx(right).epsilon(1e-11));
  }
}

TEST_CASE("without force, the offset is the one that makes the coupling's force zero, and no number is denormal" *
          doctest::test_suite("numbers")) {
  const Relaxing coupling({400, 1}, two_branches, relaxing_T);
  Relaxing::Memory<Vector3d> memory{};
  Vector3d e(1e-3, -2e-3, 5e-4);
  coupling.advance(memory, e, Vector3d());
  for (int k = 0; k < 200000; ++k) {
    const Vector3d next = without_denormals(coupling.free_offset(e, memory));
    if (k < 100) {
      const Vector3d force = coupling.holding_force(Vector3d(), Vector3d(), e, memory) + coupling.g * (next - e);
      REQUIRE(force.maxAbs() < 1e-13);
    }
    coupling.advance(memory, next, e);
    e = next;
    for (const Vector3d& f : memory.force)
      for (const double x : f) REQUIRE(std::fpclassify(x) != FP_SUBNORMAL);
  }
}

TEST_CASE("a run goes on from a kept state with the same bits, and its branches are part of the parameters") {
  Noise noise(502);
  const Scene scene = relaxing_scene();
  Insertion one = build_insertion(scene), other = build_insertion(scene);
  const Vector3d down(0, -1, 0);
  const auto motion = random_motion(noise, 2000, 8e-3, relaxing_T);
  for (std::size_t k = 0; k < 1000; ++k) one.step(motion[k] * down, down);
  REQUIRE(load_state(other, save_state(one)));
  for (std::size_t k = 1000; k < 2000; ++k)
    REQUIRE(one.step(motion[k] * down, down) == other.step(motion[k] * down, down));

  Scene stiffer = scene;
  stiffer.relaxation[1].stiffness *= 2;
  Insertion no = build_insertion(stiffer), plain = build_insertion(paper_scene());
  CHECK(!load_state(no, save_state(one)));
  CHECK(!load_state(plain, save_state(one)));
}

TEST_CASE("a scene gets branches and loses them during an insertion, and the device's force does not jump") {
  Scene plain = relaxing_scene();
  plain.relaxation.clear();
  Scene one_branch = relaxing_scene();
  one_branch.relaxation.pop_back();
  const std::array<Scene, 5> scenes{plain, relaxing_scene(), one_branch, relaxing_scene(), plain};
  ServoStep step = build(scenes[0], {}, {100, 100});
  step.arm();
  std::uint64_t k = 0;
  double y = 2e-3, before = 0;
  const auto tick = [&](double to) {
    y = to;
    const Snapshot& s = step.step(reading(k++, y));
    REQUIRE(std::abs(s.force[1] - before) < 0.03);
    before = s.force[1];
    return s;
  };
  while (y > -12e-3) tick(y - 20e-3 * relaxing_T);
  for (const Scene& scene : scenes) {
    for (int i = 0; i < 800; ++i) tick(y);
    const double depth = step.snapshot().membranes[0].depth;
    ServoStep next = build(scene, {}, {100, 100});
    next.resume(step);
    step = next;
    tick(y);
    CHECK(step.snapshot().membranes[0].depth == doctest::Approx(depth).epsilon(1e-6));
    CHECK(inside(step.snapshot().membranes[0].phase));
    for (int i = 0; i < 40; ++i) tick(y - 10e-3 * relaxing_T);
  }
  while (y < 2e-3) tick(y + 20e-3 * relaxing_T);
}
