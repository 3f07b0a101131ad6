#include "punctura/servo/servo_step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "../support/allocations.hpp"
#include "../support/cases.hpp"
#include "../support/paper_scene.hpp"
#include "../support/tick.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

static_assert(noexcept(std::declval<ServoStep&>().step(std::declval<const DeviceSample&>())));
static_assert(noexcept(std::declval<ServoStep&>().arm()) && noexcept(std::declval<ServoStep&>().disarm()) &&
              noexcept(std::declval<ServoStep&>().reset()));
static_assert(noexcept(std::declval<Insertion&>().step(std::declval<const Vector3d&>(),
                                                       std::declval<const Vector3d&>())));
static_assert(noexcept(std::declval<InsertionF&>().step(std::declval<const Vector3<float>&>(),
                                                        std::declval<const Vector3<float>&>())));
static_assert(noexcept(std::declval<Proxy1d<ThickLaw>&>().step(0.0)) &&
              noexcept(std::declval<Proxy1d<ThinLawF>&>().step(0.0f)));
static_assert(noexcept(std::declval<ForceLimiter&>().step(std::declval<const Vector3d&>())));
static_assert(noexcept(std::declval<InputGate&>().step(std::declval<const DeviceSample&>())));

namespace {

/// Moves the tip of a servo step along y, one reading per tick.
class Driver {
 public:
  explicit Driver(ServoStep& step) : step_(step) {}
  const Snapshot& to(double y, int ticks, double from) {
    for (int i = 1; i <= ticks; ++i) step_.step(reading(k_++, from + (y - from) * i / ticks));
    return step_.snapshot();
  }
  const Snapshot& stay(double y, int ticks) { return to(y, ticks, y); }
  std::uint64_t next() const { return k_; }

 private:
  ServoStep& step_;
  std::uint64_t k_ = 0;
};
}  // namespace

TEST_CASE("while disarmed, the model runs and the device gets no force") {
  auto step = build(paper_scene());
  Driver drive(step);
  drive.stay(1e-3, 10);
  const Snapshot& s = drive.to(-3e-3, 1600, 1e-3);
  CHECK(s.model_force[1] > 0.3);
  CHECK(s.force == zero);
  CHECK(s.state == ServoState::disarmed);
}

TEST_CASE("force starts only after the tip was in front of every membrane, with a ramp of half a second") {
  auto step = build(paper_scene());
  Driver drive(step);
  step.arm();
  CHECK(drive.stay(-2e-3, 100).state == ServoState::waiting);
  CHECK(drive.to(1e-3, 800, -2e-3).state == ServoState::active);
  drive.to(-2e-3, 100, 1e-3);
  const Snapshot& early = drive.stay(-2e-3, 1);
  CHECK(early.force[1] > 0);
  CHECK(early.force[1] < 0.7 * early.model_force[1]);
  const Snapshot& late = drive.stay(-2e-3, 1000);
  CHECK(late.force == late.model_force);
}

TEST_CASE("a step that is armed inside tissue waits until the tip is outside") {
  auto step = build(paper_scene());
  Driver drive(step);
  drive.stay(1e-3, 10);
  drive.to(-3e-3, 1600, 1e-3);
  step.arm();
  const Snapshot& s = drive.stay(-3e-3, 100);
  CHECK(s.state == ServoState::waiting);
  CHECK(s.force == zero);
  CHECK(s.model_force[1] > 0.1);
}

TEST_CASE("each fault sets the force to zero in its tick and stays latched until reset and arming") {
  struct Case {
    Fault fault;
    void (*spoil)(DeviceSample&);
  };
  const Case all[] = {
      {Fault::non_finite_input, [](DeviceSample& s) { s.position[1] = std::numeric_limits<double>::quiet_NaN(); }},
      {Fault::non_finite_input, [](DeviceSample& s) { s.axis[2] = std::numeric_limits<double>::infinity(); }},
      {Fault::bad_axis, [](DeviceSample& s) { s.axis = {0, -2, 0}; }},
      {Fault::position_jump, [](DeviceSample& s) { s.position[0] += 0.01; }},
      {Fault::missed_deadline, [](DeviceSample& s) { s.time += 0.1; }},
      {Fault::device, [](DeviceSample& s) { s.healthy = false; }},
  };
  for (const Case& c : all) {
    auto step = build(paper_scene());
    Driver drive(step);
    step.arm();
    drive.stay(1e-3, 1600);
    REQUIRE(drive.to(-3e-3, 1600, 1e-3).force[1] > 0.3);

    DeviceSample bad = reading(drive.next(), -3e-3);
    c.spoil(bad);
    CHECK(step.step(bad).fault == c.fault);
    CHECK(step.snapshot().force == zero);
    CHECK(step.snapshot().state == ServoState::faulted);

    const std::uint64_t before = step.snapshot().tick;
    step.arm();
    step.disarm();
    drive.stay(-3e-3, 50);
    CHECK(step.snapshot().fault == c.fault);
    CHECK(step.snapshot().force == zero);
    CHECK(step.snapshot().tick == before + 50);

    step.reset();
    CHECK(drive.to(1e-3, 1600, -3e-3).state == ServoState::disarmed);
    CHECK(step.snapshot().fault == Fault::none);
    step.arm();
    drive.stay(1e-3, 1600);
    CHECK(drive.to(-3e-3, 1600, 1e-3).force[1] > 0.3);
  }
}

TEST_CASE("a reading that never changes gives the fault stale_sample") {
  auto step = build(paper_scene());
  DeviceSample s = reading(0, 1e-3);
  for (int k = 0; k < 40; ++k) {
    s.time = k / 1600.0;
    step.step(s);
  }
  CHECK(step.fault() == Fault::stale_sample);
}

TEST_CASE("a model force that is not a number gives a fault and zero force") {
  auto scene = paper_scene();
  scene.coupling.damping = 1e307;  // B / T is infinite
  auto step = build(scene);
  step.arm();
  Driver drive(step);
  REQUIRE(drive.stay(1e-3, 1600).state == ServoState::active);
  const Snapshot& s = drive.to(-3e-3, 100, 1e-3);
  CHECK(s.fault == Fault::non_finite_force);
  CHECK(s.state == ServoState::faulted);
  CHECK(s.force == zero);
  CHECK(s.model_force == zero);
}

TEST_CASE("build() refuses an empty scene and names the missing fields") {
  const Scene empty;
  std::string missing;
  for (const Problem& problem : check(empty)) missing += problem.path + " ";
  CHECK(missing == "needle.diameter needle.tip_angle coupling.stiffness coupling.damping membrane ");
  Scene one;
  one.membranes.emplace_back();
  missing.clear();
  for (const Problem& problem : check(one)) missing += problem.path + " ";
  CHECK(missing ==
        "needle.diameter needle.tip_angle coupling.stiffness coupling.damping membrane[0].stiffness "
        "membrane[0].precompression membrane[0].friction membrane[0].thickness membrane[0].point "
        "membrane[0].inward_normal ");
}

TEST_CASE("the snapshot contains the whole tick") {
  auto step = build(paper_scene());
  step.arm();
  Driver drive(step);
  drive.stay(1e-3, 1600);
  const Snapshot& s = drive.to(-3e-3, 1600, 1e-3);
  CHECK(s.tick == 3199);
  CHECK(s.membrane_count == 1);
  CHECK(s.membranes[0].phase == Phase::sliding_in);
  CHECK(s.membranes[0].axial_force == doctest::Approx(-s.model_force[1]));
  CHECK(s.membranes[0].lower == doctest::Approx(s.membranes[0].axial_force));
  CHECK(s.membranes[0].depth == doctest::Approx(-s.membranes[0].proxy[1]));
  CHECK(s.membranes[0].direction == std::array<double, 3>{0, -1, 0});
  CHECK(s.sample.position[1] == doctest::Approx(-3e-3));
}

namespace {
Scene without(Scene scene, std::ptrdiff_t i) {
  scene.membranes.erase(scene.membranes.begin() + i);
  return scene;
}
}  // namespace

TEST_CASE("a membrane that is removed removes only its own force") {
  for (Solver solver : {Solver::paper, Solver::exact}) {
    auto scene = three_walls();
    scene.servo.solver = solver;
    auto step = build(scene);
    step.arm();
    Driver drive(step);
    drive.stay(1e-3, 1600);
    const Snapshot before = drive.to(-5e-3, 1600, 1e-3);
    REQUIRE(before.membranes[1].axial_force < -0.1);

    auto next = build(without(scene, 0));
    next.resume(step);
    Driver after(next);
    const Snapshot& s = next.step(reading(drive.next(), -5e-3));
    CHECK(s.membranes[0].phase == Phase::sticking);
    CHECK(s.membranes[0].axial_force == doctest::Approx(before.membranes[1].axial_force).epsilon(0.05));
    CHECK(s.membranes[1].phase == Phase::outside);
    CHECK((to_vector(s.force) - to_vector(before.force)).norm() < 0.02);  // the rest is faded out
  }
}

TEST_CASE("membranes can change their order, and two can be at one place") {
  auto scene = three_walls();
  scene.membranes[2].point = scene.membranes[1].point;
  auto step = build(scene);
  step.arm();
  Driver drive(step);
  drive.stay(1e-3, 1600);
  const Snapshot before = drive.to(-5e-3, 1600, 1e-3);
  std::swap(scene.membranes[0], scene.membranes[2]);
  auto next = build(scene);
  next.resume(step);
  const Snapshot& s = next.step(reading(drive.next(), -5e-3));
  CHECK(s.membranes[2].axial_force == doctest::Approx(before.membranes[0].axial_force).epsilon(0.05));
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) CHECK(s.membranes[i].phase != Phase::barred);
}

TEST_CASE("a run starts with the budget that the last run has left") {
  auto step = build(paper_scene());
  step.set_spent(3);
  CHECK(step.spent() == 3);
  step.step(reading(0, 1e-3));
  CHECK(step.snapshot().ceiling == doctest::Approx(0.88 * std::sqrt(0.75)));
  auto next = build(paper_scene());
  next.resume(step);
  CHECK(next.spent() == step.spent());
}

TEST_CASE("many ticks allocate no memory, and two runs have the same force, bit for bit" *
          doctest::test_suite("numbers")) {
  auto scene = paper_scene();
  scene.membranes.push_back({"second", paper_membrane(0.5e-3), {0, -3e-3, 0}, {0, -1, 0}});
  for (Solver solver : {Solver::paper, Solver::exact}) {
    for (Direction direction : {Direction::stylus, Direction::motion}) {
      scene.servo.solver = solver;
      scene.direction = direction;
      auto step = build(scene), again = build(scene);
      step.arm();
      again.arm();
      const auto ticks = std::uint64_t{1000} * static_cast<std::uint64_t>(at_most(250));
      const std::size_t before = allocations();
      for (std::uint64_t k = 0; k < ticks; ++k) {
        const double y = -3e-3 + 6e-3 * std::cos(2e-3 * static_cast<double>(k));
        step.step(reading(k, y));
        again.step(reading(k, y));
      }
      CHECK(allocations() == before);
      CHECK(step.fault() == Fault::none);
      CHECK(step.snapshot().force == again.snapshot().force);
    }
  }
}
