#include "punctura/lab/plant/tip_motion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <string>

#include "../support/cases.hpp"
#include "../support/paper_scene.hpp"
#include "../support/sub_stepped_tip.hpp"
#include "../support/tick.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

struct GripCase {
  std::string name;
  DeviceDynamics device;
  Hand hand;
  double bound = 1e-7;  // of the error, m
};

// Steady hands, because the tremor is the same in all methods. Mass, friction; mass, damping, stiffness.
const GripCase grips[] = {
    {"Omni, usual grip", {}, {0.05, 4, 500, 0, 9}},
    {"Omni, light grip, underdamped", {}, {0.02, 0.5, 100, 0, 9}},
    {"Omni, firm grip", {}, {0.1, 20, 3000, 0, 9}},
    {"Omni, overdamped", {}, {0.05, 60, 500, 0, 9}},
    {"Omni, critically damped", {0.05}, {0.05, 2 * std::sqrt(0.1 * 500), 500, 0, 9}},
    {"a light device, no mass of the hand", {0.01, 0.02, 0, 10}, {0, 1, 200, 0, 9}},
    {"a heavy device with much friction", {0.5, 1, 0, 20}, {0.1, 10, 1500, 0, 9}},
    {"no friction", {0.045, 0, 0, 3.3}, {0.05, 4, 500, 0, 9}},
    {"no spring", {}, {0.05, 4, 0, 0, 9}},
    {"no damper", {}, {0.05, 0, 500, 0, 9}, 1e-6},
    {"a stiff grip: two steps in a period", {0.02, 0.1, 0, 3.3}, {0, 10, 30000, 0, 9}},
};

/// The largest distances from 4096 small steps in a second: of BasicTipMotion and of 16 small steps, m. All have the
/// forces that K06's model gives at the tip of the small steps. The hand goes in and out, with a motion across. With
/// few random cases it goes in only, because the small steps take long with a sanitizer.
std::array<double, 2> errors(const GripCase& c) {
  const auto [name, device, hand, bound] = c;
  ServoStep servo = build(paper_scene());
  servo.arm();
  Plant plant(device, hand, T);
  SubSteppedTip exact, coarse;
  const auto at = [](double t) { return Vector3d(1e-3 * std::sin(11 * t), 3e-3 - 8e-3 * (1 - std::cos(9 * t)), 0); };
  exact.x = coarse.x = at(0);
  plant.place(at(0));
  double mine = 0, theirs = 0;
  const auto ticks = static_cast<std::uint64_t>(16 * at_most(100));
  for (std::uint64_t k = 0; k < ticks; ++k) {
    const double t = static_cast<double>(k) * T;
    const Desired desired{at(t), (at(t + T) - at(t)) / T};
    const Vector3d force = to_vector(servo.step({k, t, to_array(exact.x), {0, -1, 0}, 0, true}).force);
    const Vector3d held = device.saturate(force);
    plant.step(force, desired);
    exact.step(device, hand, T, 4096, held, desired);
    coarse.step(device, hand, T, 16, held, desired);
    mine = std::max(mine, (plant.tip() - exact.x).norm());
    theirs = std::max(theirs, (coarse.x - exact.x).norm());
  }
  return {mine, theirs};
}

}  // namespace

TEST_CASE("the tip moves as with 4096 small steps in a period, closer than with 16" * doctest::test_suite("numbers")) {
  for (const GripCase& c : grips) {
    CAPTURE(c.name);
    const auto error = errors(c);  // mine, then theirs
    CAPTURE(error[1]);
    CHECK(error[0] < c.bound);
    CHECK(error[0] < 0.6 * error[1]);
  }
}

TEST_CASE("without friction the response is exact for every damping") {
  for (const double damping : {0.0, 0.5, 12.0, 13.0, 300.0, 1e5})
    for (const double stiffness : {0.0, 1e-6, 500.0, 1e5}) {
      const double m = 0.1, w = stiffness / m, a = damping / m / 2, time = 0.01;
      CAPTURE(damping);
      CAPTURE(stiffness);
      const std::complex<double> root = std::sqrt(std::complex<double>(a * a - w)), fast = -a - root, slow = -a + root;
      const TipResponse r = tip_response(DeviceDynamics{0.04, 0, 0, 1}, Hand{0.06, damping, stiffness, 0, 9}, time);
      const auto velocity =
          root == 0.0 ? time * std::exp(-a * time) : (std::exp(slow * time) - std::exp(fast * time)) / (slow - fast);
      CHECK(r.velocity * m == doctest::Approx(velocity.real()).epsilon(1e-9));
    }
}

TEST_CASE("a tip that friction holds keeps its position to the last bit, and breaks away at the friction's force") {
  const DeviceDynamics device;
  for (const double share : {0.999, 1.001}) {
    Plant plant(device, {0.05, 4, 500, 0, 9}, T);
    plant.place({1e-3, 0, 0});
    const Desired desired{{1e-3, share * device.friction / 500, 0}, {}};
    for (int k = 0; k < 1600; ++k) plant.step({}, desired);
    CHECK((plant.tip() == Vector3d(1e-3, 0, 0)) == (share < 1));
    CHECK(plant.velocity() == Vector3d());
  }
}

TEST_CASE("a grip of any stiffness and damping stays finite and calm" * doctest::test_suite("numbers")) {
  for (const double stiffness : {0.0, 1e4, 1e6, 1e9, 1e15})
    for (const double damping : {0.0, 1e3, 1e6, 1e12})
      for (const double friction : {0.0, 0.26, 50.0}) {
        Plant plant({1e-3, friction, 0, 3.3}, {0, damping, stiffness, 0, 9}, 1e-2);
        plant.place({1e-3, 0, 0});
        double furthest = 0;
        for (int k = 0; k < at_most(500); ++k) {
          plant.step({}, {});
          furthest = std::max(furthest, plant.tip().norm());
        }
        CHECK(furthest <= 1.0001e-3);
      }
}
