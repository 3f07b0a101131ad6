#include "punctura_runtime/loop/servo_loop.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "core/support/allocations.hpp"
#include "core/support/tick.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
struct Cranked {
  explicit Cranked(Scene scene = paper_scene(), double rate = 1600, LoopSettings settings = {}) {
    auto made = std::make_unique<HandCranked>(rate);
    device = made.get();
    loop = std::make_unique<ServoLoop>(std::move(made), std::move(scene), settings);
  }
  /// Arms, waits for the end of the ramp, and moves into the tissue.
  void into_tissue() {
    loop->start();
    loop->arm();
    device->move(2e-3, 1e-3, 1600);
    device->move(1e-3, -3e-3, 1600);
  }
  HandCranked* device;
  std::unique_ptr<ServoLoop> loop;
};
}  // namespace

TEST_CASE("a loop gives the force of its scene, tick by tick, after start and arm") {
  Cranked c;
  c.loop->start();
  CHECK(c.device->move(1e-3, -3e-3, 100) == zero);
  CHECK(c.loop->latest().state == ServoState::disarmed);
  Cranked armed;
  armed.into_tissue();
  CHECK(armed.loop->latest().force[1] > 0.3);
  CHECK(armed.loop->latest().state == ServoState::active);
}

TEST_CASE("a tick allocates no memory, whatever other threads request of the loop" * doctest::test_suite("numbers")) {
  Cranked c;
  c.loop->listen(64);
  c.into_tissue();
  c.loop->pause();
  c.loop->arm();
  const std::size_t before = allocations();
  c.device->move(-3e-3, 2e-3, 3000);
  CHECK(allocations() == before);
}

TEST_CASE("a pause ends the force at once; it returns only after the tip was outside") {
  Cranked c;
  c.into_tissue();
  c.loop->pause();
  CHECK(c.device->tick(-3e-3) == zero);
  c.loop->arm();
  CHECK(c.device->move(-3e-3, -3.1e-3, 100) == zero);
  c.device->move(-3.1e-3, 1e-3, 1600);
  c.device->move(1e-3, 1e-3, 1000);
  CHECK(c.device->move(1e-3, -3e-3, 1600)[1] > 0.3);
}

TEST_CASE("a fault keeps the last 1000 snapshots, the faulty one last, until a reset") {
  Cranked c;
  c.into_tissue();
  CHECK(c.loop->fault_history().empty());
  DeviceSample bad = reading(999999, std::numeric_limits<double>::quiet_NaN());
  bad.time = c.loop->latest().sample.time + 1 / 1600.0;
  CHECK(c.device->tick(bad) == zero);
  for (int k = 0; k < 50; ++k) CHECK(c.device->tick(-3e-3) == zero);

  const auto history = c.loop->fault_history();
  REQUIRE(history.size() == 1000);
  CHECK(history.back().fault == Fault::non_finite_input);
  CHECK(history[998].fault == Fault::none);
  CHECK(history[998].force[1] > 0.3);
  for (std::size_t i = 1; i < history.size(); ++i) REQUIRE(history[i].tick == history[i - 1].tick + 1);

  c.loop->reset();
  c.device->move(-3e-3, 1e-3, 1600);
  CHECK(c.loop->fault_history().empty());
  CHECK(c.loop->latest().state == ServoState::disarmed);
}

TEST_CASE("a new scene is taken between two ticks, and the hand feels no jump") {
  for (double friction : {0.05, 0.2, 0.6}) {
    Cranked c;
    c.into_tissue();
    const double held = c.device->move(-3e-3, -3e-3, 50)[1];
    auto scene = paper_scene();
    scene.membranes[0].membrane.friction = friction;
    c.loop->exchange(scene);  // no tick comes: the call stops waiting, and the next tick takes the scene
    double last = held, largest_step = 0;
    for (int k = 0; k < 640; ++k) {
      const double f = c.device->tick(-3e-3)[1];
      largest_step = std::max(largest_step, std::abs(f - last));
      last = f;
    }
    CHECK(largest_step < 0.01);
    c.device->move(-3e-3, -5.5e-3, 2000);
    const auto membrane = c.loop->latest().membranes[0];
    CHECK(membrane.phase == Phase::sliding_in);
    const ThickLaw law(scene.needle, scene.membranes[0].membrane);
    CHECK(c.loop->latest().force[1] == doctest::Approx(-law.band(membrane.depth).lower));
  }
}

TEST_CASE("an invalid scene is refused, and the old one continues") {
  Cranked c;
  c.into_tissue();
  auto scene = paper_scene();
  scene.membranes[0].membrane.friction = -1;
  CHECK_THROWS_AS(c.loop->exchange(scene), SceneError);
  CHECK(c.device->move(-3e-3, -3.5e-3, 400)[1] > 0.3);
}

TEST_CASE("a membrane at another place starts new: no force until the tip has been outside") {
  Cranked c;
  c.into_tissue();
  auto scene = paper_scene();
  scene.membranes[0].point = {0, -1e-3, 0};
  c.loop->exchange(scene);
  c.device->move(-3e-3, -3e-3, 800);
  CHECK(c.loop->latest().membranes[0].phase == Phase::barred);
  CHECK(c.loop->latest().force == zero);
}

TEST_CASE("T is the device's own period, whatever rate the scene has") {
  Cranked c(paper_scene(), 1000);
  CHECK(c.loop->scene().servo.rate == 1000);
  auto at_1000 = paper_scene();
  at_1000.servo.rate = 1000;
  auto expected = build_insertion(at_1000);
  c.into_tissue();
  for (int i = 1; i <= 1600; ++i) expected.step({0, 2e-3 - 1e-3 * i / 1600, 0}, {0, -1, 0});
  for (int i = 1; i <= 1600; ++i) expected.step({0, 1e-3 - 4e-3 * i / 1600, 0}, {0, -1, 0});
  CHECK(c.loop->latest().model_force[1] == doctest::Approx(expected.force().y()).epsilon(1e-9));
}

TEST_CASE("limits are never wider than the device's own ratings") {
  auto made = std::make_unique<HandCranked>();
  made->described().max_force = 0.2;
  made->described().continuous_force = 0.1;
  auto* device = made.get();
  ServoLoop loop(std::move(made), paper_scene());
  CHECK(loop.limits().max_force == 0.2);
  loop.start();
  loop.arm();
  device->move(2e-3, 1e-3, 1600);
  CHECK(device->move(1e-3, -3e-3, 1600)[1] <= 0.2);
  CHECK(device->given().max_force == 0.2);  // the last guard before the motor
  CHECK(loop.latest().limits.peak > 0);
}

TEST_CASE("with a placement (moved, rotated, scaled) the device gets the same force in its own axes") {
  // The device points along its +x where the scene points down, is 0.1 m away, moves half as far, and its tip is 20 mm
  // ahead.
  LoopSettings settings;
  settings.placement.rotation = {std::sqrt(0.5), 0, 0, -std::sqrt(0.5)};  // a quarter turn about z: x to -y
  settings.placement.scale = 2;
  settings.placement.tip_offset = 0.02;
  settings.placement.offset = {0, 0.02 + 0.2, 0};
  Cranked turned(paper_scene(), 1600, settings), plain(paper_scene());
  for (Cranked* c : {&turned, &plain}) {
    c->loop->start();
    c->loop->arm();
  }
  double worst = 0;
  for (int k = 1; k <= 4800; ++k) {
    const double y = 1e-3 - (k < 1600 ? 0 : 4e-3 * (k - 1600) / 3200.0);
    DeviceSample sample = reading(static_cast<std::uint64_t>(k), 0);
    sample.position = {0.1 - y / 2, 0, 0};
    sample.axis = {1, 0, 0};
    const auto f = turned.device->tick(sample), g = plain.device->tick(reading(static_cast<std::uint64_t>(k), y));
    worst = std::max({worst, std::abs(f[0] + g[1]), std::abs(f[1]), std::abs(f[2])});
    REQUIRE(std::abs(turned.loop->latest().sample.position[1] - y) < 1e-15);
  }
  CHECK(worst < 1e-9);
  CHECK(plain.loop->latest().force[1] > 0.3);
}

TEST_CASE("an invalid placement is refused") {
  LoopSettings settings;
  settings.placement.scale = 0;
  settings.placement.rotation = {0, 0, 0, 0};
  CHECK_THROWS_AS(Cranked(paper_scene(), 1600, settings), SceneError);
}

TEST_CASE("every listener gets every snapshot; a slow listener loses only its own") {
  Cranked c;
  auto& awake = c.loop->listen(256);
  auto& asleep = c.loop->listen(400);
  c.loop->start();
  std::uint64_t next = 0;
  for (int i = 0; i < 40; ++i) {
    c.device->move(1e-3, 1e-3, 100);
    awake.pop(1000, [&](const Snapshot& s) { CHECK(s.tick == next++); });
  }
  CHECK(next == 4000);
  CHECK(awake.lost() == 0);
  CHECK(asleep.lost() == 4000 - 400);
}

TEST_CASE("periods, compute times and late ticks are measured with the given clock") {
  static thread_local std::int64_t now;  // the thread that watches the loop has one of its own
  now = 1;
  LoopSettings settings;
  settings.now_ns = []() noexcept { return now += 1000; };
  Cranked c(paper_scene(), 1600, settings);
  c.loop->start();
  for (int k = 0; k < 1000; ++k) {
    now += k == 500 ? 2'000'000 : 623'000;
    c.device->tick(1e-3);
  }
  const LoopReport report = c.loop->report();
  CHECK(report.ticks == 1000);
  CHECK(report.late == 1);
  CHECK(static_cast<double>(Histogram::quantile(report.period, 0.5)) == doctest::Approx(625'000).epsilon(0.13));
  CHECK(report.largest_period_ns == 2'002'000);
  CHECK(static_cast<double>(Histogram::quantile(report.compute, 0.999)) == doctest::Approx(1000).epsilon(0.13));
}
