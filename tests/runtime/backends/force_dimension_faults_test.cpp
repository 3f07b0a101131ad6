// Every failure of a Force Dimension device, simulated by the fake library.
#include <doctest/doctest.h>

#include "fakes/drd/rig.hpp"
#include "runtime/support/hanging_tick.hpp"
#include "runtime/support/soon.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr std::int64_t ms = 1'000'000;

void check_without_force(const fake_drd::Report& report) {
  for (const double component : report.force) CHECK(component == 0);
}

/// Whether the force ended within 10 ms of the event and has stayed zero.
void check_ended(const FakeRig& rig) {
  const auto report = fake().state();
  CHECK(report.injected > 0);
  CHECK(report.last_force <= report.injected + 10 * ms);
  CHECK(report.now >= rig.time());
  check_without_force(report);
}

}  // namespace

TEST_CASE("after each fault of the device its force is zero within 10 ms and stays zero, with the reason") {
  struct Case {
    fake_drd::Injected what;
    Fault fault;
    const char* words;  ///< of the device; those that the loop finds by itself have none
    bool ends;          ///< ticks cease
  };
  const Case cases[] = {
      {fake_drd::unplug, Fault::device, "USB cable", true},
      {fake_drd::press_button, Fault::device, "force button was pressed", false},
      {fake_drd::let_go, Fault::device, "dead-man", false},
      {fake_drd::switched_off, Fault::device, "a program switched", false},
      {fake_drd::lose_zero, Fault::device, "calibration pit", false},
      {fake_drd::fault_inside, Fault::device, "fault of its controller", false},
      {fake_drd::failing_read, Fault::device, "cannot be read: the device did not answer", true},
      {fake_drd::failing_write, Fault::device, "takes no force: the device did not answer", true},
      {fake_drd::failing_status, Fault::device, "cannot be read", true},
      {fake_drd::nan_position, Fault::non_finite_input, "", false},
      {fake_drd::leap, Fault::position_jump, "", false},
  };
  for (const double rate : {1600.0, 4000.0}) {
    for (const Case& c : cases) {
      CAPTURE(rate);
      CAPTURE(c.what);
      auto settings = upright();
      settings.watchdog = 1e9;  // the device's own watchdog is not needed
      FakeRig rig(settings, rate);
      rig.push_in();
      REQUIRE(fake().state().force[2] > 0.2);
      fake().inject(c.what, rig.time() + 3'300'000);
      rig.run(0.2);
      check_ended(rig);
      CHECK(rig.loop.latest().fault == c.fault);
      CHECK(rig.device->finished() == c.ends);
      const std::string trouble = rig.device->trouble();
      CHECK_MESSAGE(trouble.find(c.words) < trouble.size() + (*c.words ? 0 : 1), trouble);

      // The force stays zero even after a reset of the loop's fault, outside and armed.
      if (c.fault != Fault::device || (rate > 1600 && c.what != fake_drd::press_button)) continue;
      rig.loop.reset();
      rig.loop.arm();
      fake().target(0, 0, 5e-3);
      rig.run(1);
      fake().target(0, 0, -4e-3);
      rig.run(1);
      check_ended(rig);
    }
  }
}

TEST_CASE("a tick that requests force after a fault gets none") {
  for (const auto what :
       {fake_drd::press_button, fake_drd::lose_zero, fake_drd::failing_read, fake_drd::failing_write}) {
    CAPTURE(what);
    auto settings = upright();
    settings.watchdog = 1e9;
    FakeRig rig(settings);
    CrankedClock::reset();
    rig.device->start({[](void*, const DeviceSample&) noexcept { return Tick::Force{0.1, 0.2, 0.3}; }, nullptr, 5});
    const auto begin = fake().now();
    CrankedClock::run_to(begin + 100 * ms, *rig.device);
    CHECK(fake().state().sent[2] == 0.2);
    fake().inject(what, begin + 100 * ms);
    CrankedClock::run_to(begin + 110 * ms, *rig.device);
    CrankedClock::run_to(begin + 500 * ms, *rig.device);
    const auto report = fake().state();
    for (const double component : report.sent) CHECK(component == 0);
    CHECK(report.last_force <= report.injected + 10 * ms);
    CrankedClock::release();
    rig.device->stop();
  }
}

TEST_CASE("a hand that moves the device too fast triggers its brakes, and no force follows") {
  auto settings = upright();
  settings.brake_speed = 0.6;
  FakeRig rig(settings);
  rig.push_in();
  fake().target(0, 0.08, 0.03);
  rig.run(1);
  check_ended(rig);
  CHECK(rig.loop.latest().fault == Fault::device);
  CHECK(rig.device->trouble().find("faster than its own limit") < 200);
}

TEST_CASE("if the computer stalls for 100 ms, the device's own watchdog ends the force") {
  FakeRig rig;
  rig.push_in();
  const auto before = rig.time();
  CrankedClock::stall(100 * ms);
  rig.run(1);
  const auto report = fake().state();
  CHECK(report.last_force > before);
  CHECK(report.last_force <= before + 12 * ms);  // the fake's watchdog, 10 ms, after the last command
  check_without_force(report);
  CHECK(rig.loop.latest().fault != Fault::none);
  CHECK(rig.device->missed() > 100);
  CHECK(rig.device->trouble().find("watchdog") < 200);
}

TEST_CASE("repeated readings end the force after the loop's limit for stale samples") {
  FakeRig rig;
  rig.push_in();
  fake().inject(fake_drd::freeze, rig.time());
  rig.run(1);
  const auto report = fake().state();
  CHECK(report.last_force <= report.injected + static_cast<std::int64_t>(GateLimits{}.stale * 1e9) + 2 * ms);
  check_without_force(report);
  CHECK(rig.loop.latest().fault == Fault::stale_sample);
}

TEST_CASE("stop leaves zero force, motors off and the device closed; a second stop is harmless; it can start again") {
  FakeRig rig;
  rig.push_in();
  rig.stop();
  const auto stopped = fake().state();
  for (const double component : stopped.sent) CHECK(component == 0);
  check_without_force(stopped);
  CHECK(stopped.force_on == 0);
  CHECK(stopped.open == 0);
  CHECK(stopped.touched_safety == 0);
  const auto ticks = rig.loop.report().ticks;
  rig.stop();
  rig.device->stop();
  CHECK(fake().state().writes == stopped.writes);
  CHECK(rig.loop.report().ticks == ticks);

  rig.start();
  rig.run(0.1);
  CHECK(fake().state().force_on == 1);
  CHECK(rig.loop.report().ticks > ticks + 100);
}

TEST_CASE("a running device stops before it is destroyed") {
  auto rig = std::make_unique<FakeRig>();
  rig->push_in();
  CHECK(fake().state().force[2] > 0.2);
  CrankedClock::release();
  rig.reset();
  const auto left = fake().state();
  for (const double component : left.sent) CHECK(component == 0);
  CHECK(left.force_on == 0);
  CHECK(left.open == 0);
}

TEST_CASE("a device whose motors were off earlier is usable; motors that do not turn on are an error") {
  auto settings = upright();
  settings.old_force_off_cause = 4;
  FakeRig rig(settings);
  rig.push_in();
  CHECK(rig.device->trouble() == "");
  CHECK(fake().state().force[2] > 0.2);
  rig.stop();

  settings.starts_forces = 0;
  FakeRig dark(settings);
  dark.start();
  dark.run(0.4);
  CHECK(dark.device->trouble() == "");
  dark.run(0.2);
  CHECK(dark.loop.latest().fault == Fault::device);
  CHECK(dark.device->trouble().find("has not switched its force on") < 100);
}

TEST_CASE("if a tick does not return, stop() switches the force off meanwhile") {
  FakeRig rig;
  HangingTick model(100);
  CrankedClock::reset();
  rig.device->start(model.tick());
  CrankedClock::release();
  CHECK(soon([&] { return model.inside(); }));
  CHECK(fake().state().sent[2] == 1);
  CHECK(fake().state().force_on == 1);
  std::thread stops([&] { rig.device->stop(); });
  CHECK(soon([] { return fake().state().force_on == 0; }));
  for (const double component : fake().state().sent) CHECK(component == 0);
  CHECK(model.inside());
  model.returns = true;
  stops.join();
  for (const double component : fake().state().sent) CHECK(component == 0);
}
