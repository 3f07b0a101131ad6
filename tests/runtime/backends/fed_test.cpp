#include "punctura_runtime/backends/fed.hpp"

#include <doctest/doctest.h>

#include <future>
#include <thread>

#include "core/support/allocations.hpp"
#include "core/support/tick.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

DeviceInfo at(double rate) {
  DeviceInfo info;
  info.rate = rate;
  return info;
}

/// The motion through the membrane from 2 mm above it: outside tissue while the force ramps in.
double height(int k) { return k < 1600 ? 2e-3 : 2e-3 - 4e-6 * (k - 1600); }
}  // namespace

TEST_CASE("every fed reading gives one tick, and feed() returns its force") {
  auto device = std::make_shared<FedDevice>(at(1600), false);
  ServoLoop loop(device, paper_scene());
  auto other = std::make_shared<HandCranked>(1600);
  ServoLoop reference(other, paper_scene());
  for (ServoLoop* each : {&loop, &reference}) {
    each->arm();
    each->start();
  }
  bool same = true;
  double strongest = 0;
  for (int k = 0; k < 3200; ++k) {
    const Tick::Force force = device->feed({{0, height(k), 0}});
    same = same && force == other->tick(height(k));
    strongest = std::max(strongest, force[1]);
  }
  CHECK(same);
  CHECK(strongest > 0.3);
  CHECK(loop.report().ticks == 3200);
  CHECK(device->fed() == 3200);
}

TEST_CASE("before start and after stop there is no tick and no force") {
  auto device = std::make_shared<FedDevice>(at(1600));
  ServoLoop loop(device, paper_scene());
  CHECK(device->feed({{0, 0, 0}}) == zero);
  CHECK(loop.report().ticks == 0);
  loop.start();
  device->feed({{0, 0, 0}});
  loop.stop();
  CHECK(device->feed({{0, 0, 0}}) == zero);
  CHECK(loop.report().ticks == 1);
}

TEST_CASE("the tick gets the fed axis, buttons, temperature and health, and a count") {
  auto device = std::make_shared<FedDevice>(at(1000), false);
  ServoLoop loop(device, paper_scene());
  loop.start();
  device->feed({{0, 1e-3, 0}});
  device->feed({{1e-3, 2e-3, 3e-3}, {0, 0, -1}, 5, true, 0.25});
  const DeviceSample sample = loop.latest().sample;
  CHECK(sample.sequence == 1);
  CHECK(sample.time == 1e-3);
  CHECK(sample.position == std::array<double, 3>{1e-3, 2e-3, 3e-3});
  CHECK(sample.axis == std::array<double, 3>{0, 0, -1});
  CHECK(sample.buttons == 5);
  CHECK(sample.motor_temperature == 0.25);
  CHECK(device->trouble().empty());
  device->feed({{0, 0, 0}, {0, -1, 0}, 0, false});
  CHECK(loop.latest().fault == Fault::device);
  CHECK_FALSE(device->trouble().empty());
}

TEST_CASE("in real time, too long a pause of the feeder gives a fault at the next reading") {
  LoopSettings settings;
  settings.gate.deadline = 1e-4;
  auto device = std::make_shared<FedDevice>(at(1000));
  ServoLoop loop(device, paper_scene(), settings);
  loop.start();
  device->feed({{0, 2e-3, 0}});
  const std::int64_t then = os::now_ns();
  while (os::now_ns() - then < 1'000'000) std::this_thread::yield();
  CHECK(device->feed({{0, 2e-3, 0}}) == zero);
  CHECK(loop.latest().fault == Fault::missed_deadline);
  REQUIRE_FALSE(device->statements().empty());
  CHECK(device->statements()[0].find("fed at") == 0);
}

TEST_CASE("a feeder at a wrong rate gets a message with its measured rate") {
  auto device = std::make_shared<FedDevice>(at(100));
  ServoLoop loop(device, paper_scene());
  loop.start();
  for (int k = 0; k < 10; ++k) device->feed({{0, 2e-3, 0}});
  REQUIRE_FALSE(device->statements().empty());
  CHECK(device->statements()[0].find("not at the rate") != std::string::npos);
}

TEST_CASE("stop waits for another thread's tick, and the next reading gets no tick") {
  auto device = std::make_shared<FedDevice>(at(1600), false);
  std::atomic<bool> enough{false};
  auto loop = std::make_unique<ServoLoop>(device, paper_scene());
  loop->start();
  std::thread feeder([&] {
    while (!enough) device->feed({{0, 2e-3, 0}});
  });
  while (loop->report().ticks < 1000) std::this_thread::yield();
  loop.reset();  // stopped and destroyed while the feeder continues
  enough = true;
  feeder.join();
  CHECK(device->feed({{0, 2e-3, 0}}) == zero);
}

TEST_CASE("questions to the device during a tick are answered at once and delay no reading") {
  struct Slow {
    std::promise<void> ticking, go_on;
    static Tick::Force tick(void* self, const DeviceSample&) noexcept {
      auto& slow = *static_cast<Slow*>(self);
      slow.ticking.set_value();
      slow.go_on.get_future().wait();
      return {0, 1, 0};
    }
  } slow;
  FedDevice device(at(1600));
  device.start({&Slow::tick, &slow, 5});
  Tick::Force force{};
  std::thread feeder([&] { force = device.feed({{0, 0, 0}}); });
  slow.ticking.get_future().wait();
  CHECK(device.statements().empty());  // of the readings that had a tick
  CHECK(device.trouble().empty());
  CHECK(device.fed() == 0);
  slow.go_on.set_value();
  feeder.join();
  CHECK(force == Tick::Force{0, 1, 0});
  CHECK(device.fed() == 1);
}

TEST_CASE("a reading fed during another tick gets no tick and no force, and is reported") {
  struct Greedy {
    FedDevice device{at(1600), false};
    Tick::Force second{1, 1, 1};
    static Tick::Force tick(void* self, const DeviceSample&) noexcept {
      auto& greedy = *static_cast<Greedy*>(self);
      greedy.second = greedy.device.feed({{0, 0, 0}});
      return {0, 1, 0};
    }
  } greedy;
  greedy.device.start({&Greedy::tick, &greedy, 5});
  CHECK(greedy.device.feed({{0, 0, 0}}) == Tick::Force{0, 1, 0});
  CHECK(greedy.second == zero);
  CHECK(greedy.device.fed() == 1);
  REQUIRE(greedy.device.statements().size() == 1);
  CHECK(greedy.device.statements()[0].find("1 readings got no tick") == 0);
}

TEST_CASE("the run reports whether the feeding thread got, was refused, or never requested real-time priority") {
  FedDevice device(at(1000));
  struct Nothing {
    static Tick::Force tick(void*, const DeviceSample&) noexcept { return {0, 0, 0}; }
  };
  device.start({&Nothing::tick, nullptr, 5});
  const auto feed_twice = [&] {
    for (int k = 0; k < 2; ++k) device.feed({{0, 0, 0}});
  };
  feed_twice();
  CHECK(device.statements().back().find("make_realtime()") != std::string::npos);

  std::vector<std::string> lines;
  std::thread([&] {
    lines = device.make_realtime({80, 0, false, false});
    feed_twice();
  }).join();
  REQUIRE(lines.size() == 2);  // priority and processor
  for (const std::string& line : lines) CHECK(line.find("granted") != std::string::npos);
  const auto all = device.statements();
  REQUIRE(all.size() == 3);
  CHECK(std::equal(lines.begin(), lines.end(), all.begin()));
  CHECK(all.back().find("fed at") == 0);
}

TEST_CASE("feeding allocates no memory") {
  auto device = std::make_shared<FedDevice>(at(1600), false);
  ServoLoop loop(device, paper_scene());
  loop.arm();
  loop.start();
  device->feed({{0, 2e-3, 0}});
  const std::size_t before = allocations();
  for (int k = 0; k < 2000; ++k) device->feed({{0, height(k), 0}});
  CHECK(allocations() == before);
}

TEST_CASE("an invalid rate is refused") {
  CHECK_THROWS_AS(FedDevice(at(0)), DeviceError);
  CHECK_THROWS_AS(FedDevice(at(not_given)), DeviceError);
  CHECK(FedDevice(at(500)).info().backend == "fed");
}
