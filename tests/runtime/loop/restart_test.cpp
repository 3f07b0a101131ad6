// A loop that is stopped and started again, with requests of other threads at the same time.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "core/support/tick.hpp"
#include "punctura_runtime/backends/fed.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// A HandCranked device whose clock restarts with each start, as the clock of any back-end may.
struct Restarted {
  Restarted() : device(std::make_shared<FedDevice>(at_1600_hz(), false)), loop(device, paper_scene()) {}
  static DeviceInfo at_1600_hz() {
    DeviceInfo info;
    info.rate = 1600;
    return info;
  }
  Tick::Force move(double from, double to, int ticks) {
    Tick::Force force{};
    for (int i = 1; i <= ticks; ++i)
      force = device->feed({{0, from + (to - from) * i / ticks, 0}, {0, -1, 0}, 0, true});
    return force;
  }
  std::shared_ptr<FedDevice> device;
  ServoLoop loop;
};

}  // namespace

TEST_CASE("a stopped loop starts again without a fault, disarmed, and gives force after arming") {
  Restarted r;
  for (int run = 0; run < 3; ++run) {
    r.loop.start();
    CHECK(r.move(2e-3, -3e-3, 1600) == zero);
    CHECK(r.loop.latest().state == ServoState::disarmed);
    CHECK(r.loop.latest().fault == Fault::none);
    r.loop.arm();
    r.move(-3e-3, 2e-3, 1600);
    CHECK(r.move(2e-3, -3e-3, 3200)[1] > 0.3);
    r.loop.stop();
  }
}

TEST_CASE("arming before any start takes effect; a pause of the previous run does not") {
  Restarted r;
  for (int run = 0; run < 2; ++run) {
    r.loop.arm();
    r.loop.start();
    r.move(2e-3, 1e-3, 1600);
    CHECK(r.loop.latest().state == ServoState::active);
    r.loop.stop();
  }
}

TEST_CASE("a stop that no tick has seen has no later effect") {
  Restarted r;
  r.loop.start();
  r.move(2e-3, 1e-3, 10);
  r.loop.arm();  // no tick follows, so neither this nor the stop takes effect
  r.loop.stop();
  r.loop.start();
  r.move(2e-3, 1e-3, 10);
  CHECK(r.loop.latest().state == ServoState::disarmed);  // requests of the previous run end with it
  r.loop.stop();
  r.loop.reset();
  r.loop.arm();
  r.loop.start();
  r.move(2e-3, 1e-3, 1600);
  CHECK(r.loop.latest().state == ServoState::active);
}

TEST_CASE("a latched fault stays through a stop and a start, until a reset") {
  Restarted r;
  r.loop.start();
  r.move(2e-3, 1e-3, 10);
  r.device->feed({{0, std::numeric_limits<double>::quiet_NaN(), 0}, {0, -1, 0}, 0, true});
  r.loop.stop();
  r.loop.start();
  r.move(1e-3, 1e-3, 10);
  CHECK(r.loop.latest().fault == Fault::non_finite_input);
  CHECK_FALSE(r.loop.fault_history().empty());
  r.loop.reset();
  r.loop.arm();
  r.move(2e-3, 1e-3, 1600);
  CHECK(r.loop.latest().state == ServoState::active);
}

TEST_CASE("after a stop, the last requested scene runs") {
  Restarted r;
  auto one = paper_scene(), two = paper_scene();
  one.membranes[0].membrane.friction = 0.05;
  two.membranes[0].membrane.friction = 0.3;
  r.loop.start();
  r.move(2e-3, 1e-3, 10);
  r.loop.exchange(one);  // no tick takes it
  r.loop.stop();
  r.loop.exchange(two);
  r.loop.arm();
  r.loop.start();
  r.move(2e-3, 1e-3, 1600);
  r.move(1e-3, -8e-3, 4000);
  const auto membrane = r.loop.latest().membranes[0];
  const ThickLaw law(two.needle, two.membranes[0].membrane);
  CHECK(membrane.phase == Phase::sliding_in);
  CHECK(membrane.lower == doctest::Approx(law.band(membrane.depth).lower));
}

TEST_CASE("a second loop cannot use a running device, and the first loop continues") {
  Restarted r;
  r.loop.start();
  ServoLoop second(r.device, paper_scene());
  CHECK_THROWS_WITH_AS(second.start(), "the device runs in another loop already: stop that one first", DeviceError);
  second.stop();
  r.move(2e-3, 1e-3, 10);
  CHECK(r.loop.report().ticks == 10);
}

TEST_CASE("the end of a program stops every running loop, and no other") {
  Restarted first, second, third;
  first.loop.start();
  second.loop.start();
  third.loop.start();
  second.loop.stop();
  ServoLoop::stop_all();
  for (Restarted* r : {&first, &second, &third}) CHECK_FALSE(r->loop.running());
  first.loop.start();
  CHECK(first.loop.running());
}

TEST_CASE("the history of a fault is complete or empty, whenever another thread resets") {
  auto device = std::make_shared<HandCranked>();
  ServoLoop loop(device, paper_scene());
  loop.start();
  std::atomic<bool> over{false};
  std::thread ticking([&] {
    for (std::uint64_t k = 1; !over; ++k) {
      const double y = k % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : 5e-3;
      device->tick(DeviceSample{k, static_cast<double>(k) / 1600, {0, y, 0}, {0, -1, 0}, 0, true});
    }
  });
  int broken = 0;
  for (int i = 0; i < 5000; ++i) {
    loop.reset();
    const auto history = loop.fault_history();
    for (std::size_t j = 1; j < history.size(); ++j) broken += history[j].tick != history[j - 1].tick + 1;
    if (!history.empty()) broken += history.back().fault == Fault::none;
  }
  over = true;
  ticking.join();
  loop.stop();
  CHECK(broken == 0);
}
