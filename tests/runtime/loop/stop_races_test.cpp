// Requests to a loop while another thread stops it, as at the end of a program.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

Scene with_friction(double friction) {
  Scene scene = paper_scene();
  scene.membranes[0].membrane.friction = friction;
  return scene;
}

/// A device whose stop() waits for the test.
class SlowToStop : public HandCranked {
 public:
  void stop() noexcept override {
    stopping.set_value();
    may_stop.get_future().wait();
    HandCranked::stop();
  }
  std::promise<void> stopping, may_stop;
};

/// Of a loop that runs no more: starts it, pushes the needle in, and says whether the force is inside this friction's
/// band.
bool slides_with(HandCranked& device, ServoLoop& loop, double friction) {
  const Scene scene = with_friction(friction);
  loop.reset();
  loop.arm();
  loop.start();
  device.move(2e-3, 1e-3, 1600);
  device.move(1e-3, -8e-3, 4000);
  const auto membrane = loop.latest().membranes[0];
  const double lower = ThickLaw(scene.needle, scene.membranes[0].membrane).band(membrane.depth).lower;
  return membrane.phase == Phase::sliding_in && membrane.lower == doctest::Approx(lower);
}

}  // namespace

TEST_CASE("a new scene and the stop of another thread free each servo step once") {
  auto device = std::make_shared<HandCranked>();  // it never ticks, so an exchange waits until the stop
  ServoLoop loop(device, paper_scene());
  std::atomic<bool> over{false};
  std::atomic<int> exchanges{0};
  const auto wait_for = [&](int more) {
    for (const int until = exchanges + more; exchanges < until;) std::this_thread::yield();
  };
  std::thread changing([&] {
    for (int i = 0; !over; ++i, ++exchanges) loop.exchange(with_friction(i % 2 == 0 ? 0.05 : 0.3));
  });
  for (int run = 0; run < 100; ++run) {
    loop.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // most often a scene is waiting for a tick by then
    if (run % 2 == 0)
      ServoLoop::stop_all();
    else
      loop.stop();
    wait_for(2);  // the one that was waiting, and one that finds no run
  }
  over = true;
  changing.join();
  CHECK_FALSE(loop.running());
  loop.exchange(with_friction(0.3));
  CHECK(slides_with(*device, loop, 0.3));
  loop.stop();
}

TEST_CASE("the scene can be read in one thread while another one exchanges it") {
  auto device = std::make_shared<HandCranked>();
  ServoLoop loop(device, with_friction(0.05));
  std::atomic<bool> over{false};
  std::thread changing([&] {
    for (int i = 0; i < 200; ++i) loop.exchange(with_friction(i % 2 == 0 ? 0.3 : 0.05));
    over = true;
  });
  while (!over) {
    const double friction = loop.copy_scene().membranes[0].membrane.friction;
    CHECK((friction == 0.05 || friction == 0.3));
    CHECK(loop.force_scale() == 1);
    CHECK(loop.room() > 0);
  }
  changing.join();
}

TEST_CASE("a new scene does not wait for a driver that does not stop, and the next run uses it") {
  auto device = std::make_shared<SlowToStop>();
  ServoLoop loop(device, with_friction(0.05));
  loop.start();
  std::thread stopping([&] { loop.stop(); });
  device->stopping.get_future().wait();
  loop.exchange(with_friction(0.3));  // returns, though the stop has not
  CHECK(loop.running());
  device->may_stop.set_value();
  stopping.join();
  CHECK_FALSE(loop.running());

  device->stopping = {}, device->may_stop = {};
  CHECK(slides_with(*device, loop, 0.3));
  device->may_stop.set_value();
  loop.stop();
}

TEST_CASE("a stop waits for a start in progress, so no run is left over") {
  struct SlowToStart : HandCranked {
    void start(Tick tick) override {
      starting.set_value();
      may_start.get_future().wait();
      HandCranked::start(tick);
    }
    void stop() noexcept override {
      stopped_early = stopped_early || !started();
      HandCranked::stop();
    }
    std::promise<void> starting, may_start;
    bool stopped_early = false;
  };
  auto device = std::make_shared<SlowToStart>();
  ServoLoop loop(device, paper_scene());
  std::thread starts([&] { loop.start(); });
  device->starting.get_future().wait();
  std::thread stops([] { ServoLoop::stop_all(); });
  device->may_start.set_value();
  starts.join();
  stops.join();
  CHECK_FALSE(device->stopped_early);
  CHECK_FALSE(loop.running());
}
