// Rivals: force models of other authors, alone and in a servo step.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../support/allocations.hpp"
#include "../support/paper_scene.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura/rivals/rival_insertion.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double rival_period = 1 / 1600.0;

/// The force of a rival along a motion at a steady speed (m/s), one value a tick.
template <typename R>
std::vector<double> rival_forces(RivalRun<R>& run, double from, double to, double speed) {
  std::vector<double> force;
  const double step = (to > from ? speed : -speed) * rival_period;
  const auto n = static_cast<int>(std::abs((to - from) / step));
  for (int k = 0; k <= n; ++k) force.push_back(run.step(from + k * step, step / rival_period, rival_period));
  return force;
}

/// The depth at which a rival is punctured at a steady speed, m.
template <typename R>
double rival_pop(const R& rival, double speed) {
  RivalRun<R> run{rival, {}};
  for (double z = 0; z < 0.1; z += speed * rival_period) {
    run.step(z, speed, rival_period);
    if (run.state.punctured) return z;
  }
  return 0.1;
}

Scene rival_scene() {
  Scene scene = paper_scene();
  scene.servo.conditioning = Conditioning::line_fit;
  return scene;
}

}  // namespace

TEST_CASE("each rival gives no force in front, a finite force inside, and is untouched again after it left") {
  AnyRival::for_each_kind([]<typename R>(const R& rival) {
    CAPTURE(R::name);
    RivalRun<R> run{rival, {}};
    CHECK(run.step(-1e-3, 0.01, rival_period) == 0);
    const auto first = rival_forces(run, 1e-5, 30e-3, 20e-3);
    for (const double force : first) CHECK(std::isfinite(force));
    CHECK(*std::max_element(first.begin(), first.end()) > 0);
    rival_forces(run, 30e-3, 1e-5, 20e-3);
    CHECK(run.step(0, -0.01, rival_period) == 0);
    CHECK(rival_forces(run, 1e-5, 30e-3, 20e-3) == first);
  });
}

TEST_CASE("the default numbers of each rival are inside their bounds") {
  AnyRival::for_each_kind([]<typename R>(const R& rival) {
    for (const auto& number : R::numbers()) {
      CAPTURE(number.name);
      CHECK(rival.*number.value >= number.low);
      CHECK(rival.*number.value <= number.high);
    }
  });
}

TEST_CASE("Okamura: a quadratic force to the puncture, then friction per depth and cutting only where it is new") {
  const Okamura rival{.linear = 50, .quadratic = 5e3, .puncture = 8e-3, .cutting = 0.5, .friction_slope = 12};
  RivalRun<Okamura> run{rival, {}};
  CHECK(run.step(4e-3, 0.01, rival_period) == doctest::Approx(50 * 4e-3 + 5e3 * 16e-6));
  CHECK(run.step(10e-3, 0.01, rival_period) == doctest::Approx(0.5 + 12 * 10e-3));
  CHECK(run.step(9e-3, -0.01, rival_period) == doctest::Approx(-12 * 9e-3));
  CHECK(run.step(9.5e-3, 0.01, rival_period) == doctest::Approx(12 * 9.5e-3));  // cut before
  CHECK(run.step(11e-3, 0.01, rival_period) == doctest::Approx(0.5 + 12 * 11e-3));
}

TEST_CASE("Mahvash and Dupont: a slow needle breaks the tissue at the energy of the slow force, a fast one earlier") {
  const MahvashDupont rival{.at_1_mm = 0.05, .exponent = 1.5, .ratio = 2, .relaxation = 0.5, .puncture = 5e-4};
  const auto depth_of = [&](double force_at_1_mm) {  // k z^(n+1) / (n+1) = energy, with z in mm and k in N
    return 1e-3 * std::pow(rival.puncture * (rival.exponent + 1) / (force_at_1_mm * 1e-3), 1 / (rival.exponent + 1));
  };
  CHECK(rival_pop(rival, 1e-4) == doctest::Approx(depth_of(0.05)).epsilon(5e-3));
  CHECK(rival_pop(rival, 0.5) == doctest::Approx(depth_of(0.05 * 3)).epsilon(0.03));
  CHECK(rival_pop(rival, 0.02) < rival_pop(rival, 0.002));
}

TEST_CASE("Mahvash and Dupont: a hold relaxes by the branch's force with its time") {
  const MahvashDupont rival{.at_1_mm = 0.05, .exponent = 1.5, .ratio = 1, .relaxation = 0.5, .puncture = 1};
  RivalRun<MahvashDupont> run{rival, {}};
  const double depth = 5e-3, slow = 0.05 * std::pow(depth * 1e3, 1.5);
  rival_forces(run, 1e-6, depth, 1.0);
  const double before = run.step(depth, 0, rival_period);
  double after = 0;
  for (int k = 0; k < 800; ++k) after = run.step(depth, 0, rival_period);
  CHECK((after - slow) / (before - slow) == doctest::Approx(std::exp(-1)).epsilon(0.01));
}

TEST_CASE("Dahl: the force is that of the differential equation") {
  const Dahl rival{.stiffness = 500, .friction = 0.5, .friction_slope = 0};
  RivalRun<Dahl> run{rival, {}};
  CHECK(rival_forces(run, 1e-9, 1e-3, 0.01).back() == doctest::Approx(0.5 * (1 - std::exp(-1))).epsilon(0.01));
}

TEST_CASE("stick-slip lets go at its largest force") {
  const StickSlip rival{.stiffness = 1000, .friction = 0.5, .friction_slope = 0};
  RivalRun<StickSlip> run{rival, {}};
  CHECK(run.step(0.4e-3, 0.01, rival_period) == doctest::Approx(0.4));
  CHECK(run.step(0.6e-3, 0.01, rival_period) == 0);
  CHECK(run.step(0.5e-3, -0.01, rival_period) == doctest::Approx(-0.1));
}

TEST_CASE("a servo step runs each rival behind the same gate and limits, without an allocation in a tick") {
  const Scene scene = rival_scene();
  AnyRival::for_each_kind([&]<typename R>(R rival) {
    CAPTURE(R::name);
    if constexpr (requires { rival.friction; }) rival.friction = 50;  // far beyond the limits
    const std::vector<AnyRival> rivals(scene.membranes.size(), AnyRival(RivalRun<R>{rival, {}}));
    Experiment<StrokesMotion, RivalServoStep> experiment(build_rivals(scene, rivals), rival_period,
                                                         StrokesMotion({{0, 5e-3, 0}, {0, -10e-3, 0}, 1}, 1),
                                                         Vector3d(0, -1, 0));
    double strongest = 0;
    const std::size_t before = allocations();
    for (int k = 0; k < 4000; ++k) {
      const Snapshot& s = experiment.step();
      strongest = std::max(strongest, to_vector(s.force).norm());
    }
    CHECK(allocations() == before);
    CHECK(strongest <= ForceLimits{}.max_force + 1e-9);
    CHECK(experiment.servo().fault() == Fault::none);
  });
}

TEST_CASE("an automatic force scale follows from the rivals' forces, not from K06's") {
  Scene scene = rival_scene();
  scene.display.automatic = true;
  const auto scale = [&](double friction) {
    return build_rivals(scene, std::vector{AnyRival(RivalRun<Dahl>{{1e4, friction, 0}, {}})}).force_scale();
  };
  const double n = static_cast<double>(scene.membranes.size());
  CHECK(scale(0.01) == 1);
  CHECK(scale(2) * n * 2 == doctest::Approx(automatic_share * lasting_force({})).epsilon(0.01));
}

TEST_CASE("a number of a rival outside its bounds is a problem, before the rival can pull the needle in") {
  std::vector<Problem> problems;
  const std::vector rivals(1, AnyRival(RivalRun<SignOfVelocity>{{.friction = -1}, {}}));
  CHECK(!try_build_rivals(paper_scene(), rivals, problems));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].path == "rivals[0].friction");
}

TEST_CASE("rivals are one, or one for each membrane") {
  const Scene scene = rival_scene();
  std::vector<Problem> problems;
  CHECK(
      !try_build_rivals(scene, std::vector<AnyRival>(scene.membranes.size() + 1, *AnyRival::named("dahl")), problems));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].path == "rivals");
}

TEST_CASE("sub-steps give rivals the positions between two ticks") {
  Scene often = rival_scene(), seldom = often;
  often.servo.low_pass = seldom.servo.low_pass = 0;
  seldom.servo.rate = often.servo.rate / 4;
  Scene divided = seldom;
  divided.servo.sub_steps = 4;
  const std::vector<AnyRival> rivals(often.membranes.size(), AnyRival(RivalRun<Dahl>{{1e4, 0.1, 500}, {}}));
  RivalInsertion a(often, rivals), b(divided, rivals), c(seldom, rivals);
  const auto place = [](int k) { return Vector3d(0, 1e-3 - 5e-6 * k, 0); };
  const Vector3d down(0, -1, 0);
  double largest = 0;
  for (int k = 0; k <= 2000; ++k) {
    a.step(place(k), down);
    if (k % 4 != 0) continue;
    b.step(place(k), down);
    c.step(place(k), down);
    CHECK(b.force().y() == doctest::Approx(a.force().y()).epsilon(1e-9));
    largest = std::max(largest, std::abs(c.force().y() - a.force().y()));
  }
  CHECK(largest > 1e-4);
}

TEST_CASE("a saved run with rivals continues with the same bits, and refuses the state of other numbers") {
  const Scene scene = rival_scene();
  AnyRival::for_each_kind([&]<typename R>(R rival) {
    CAPTURE(R::name);
    const std::vector<AnyRival> rivals(scene.membranes.size(), AnyRival(RivalRun<R>{rival, {}}));
    RivalInsertion a(scene, rivals), b(scene, rivals);
    const Vector3d down(0, -1, 0);
    for (int k = 0; k < 800; ++k) a.step({0, 2e-3 - 12e-3 * k / 800, 0}, down);
    REQUIRE(load_state(b, save_state(a)));
    for (int k = 0; k < 800; ++k) {
      const Vector3d p(0, -10e-3 + 14e-3 * k / 800, 0);
      CHECK(a.step(p, down) == b.step(p, down));
    }
    rival.*R::numbers()[0].value *= 1.5;
    RivalInsertion other(scene, std::vector<AnyRival>(scene.membranes.size(), AnyRival(RivalRun<R>{rival, {}})));
    CHECK_FALSE(load_state(other, save_state(a)));
  });
}
