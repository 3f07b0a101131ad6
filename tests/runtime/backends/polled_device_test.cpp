#include "punctura_runtime/backends/polled_device.hpp"

#include <doctest/doctest.h>

#include "runtime/support/hanging_tick.hpp"
#include "runtime/support/soon.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// Ticks as often as it can, until stop() or `ticks`.
struct Bare : PolledDevice {
  explicit Bare(Pacing pacing = {false, false}) {
    info_.rate = 1000;
    pacing_ = pacing;
  }
  ~Bare() override { stop(); }
  std::string prepare() noexcept override {
    known = statements().size();
    prepared = true;
    return refusal;
  }
  Next read() noexcept override { return count() == ticks ? Next::end : Next::tick; }
  Next write(const Tick::Force& force) noexcept override {
    last = force;
    return lost ? Next::trouble : Next::tick;
  }
  void end() noexcept override {
    last = {0, 0, 0};
    ++ends;
  }

  std::string refusal;
  std::uint64_t ticks = 1'000'000'000;
  std::size_t known = 0;
  std::atomic<bool> prepared{false}, lost{false};
  std::atomic<int> ends{0};
  Tick::Force last{};
};

struct Ticks {
  std::atomic<int> healthy{0}, unhealthy{0};
  Tick tick() {
    return {[](void* to, const DeviceSample& sample) noexcept {
              ++(sample.healthy ? static_cast<Ticks*>(to)->healthy : static_cast<Ticks*>(to)->unhealthy);
              return Tick::Force{1, 2, 3};
            },
            this, 5};
  }
};

}  // namespace

TEST_CASE("start returns after the preparation, at every start") {
  Ticks ticks;
  Bare device;
  for (int i = 0; i < 2000; ++i) {
    device.prepared = false;
    device.start(ticks.tick());
    CHECK(device.prepared);
    device.stop();
  }
}

TEST_CASE("a failed preparation ends the thread before its ticks, and it can start again") {
  Ticks ticks;
  Bare device;
  device.refusal = "no power";
  CHECK_THROWS_WITH_AS(device.start(ticks.tick()), "no power", DeviceError);
  CHECK(ticks.healthy == 0);
  device.refusal = {};
  device.start(ticks.tick());
  while (ticks.healthy == 0) std::this_thread::yield();
}

TEST_CASE("a device whose ticks have ended counts as running until stop(); a second stop has no effect") {
  Ticks ticks;
  Bare device;
  device.ticks = 3;
  device.start(ticks.tick());
  while (!device.finished()) std::this_thread::yield();
  CHECK(ticks.healthy == 3);
  CHECK_THROWS_AS(device.start(ticks.tick()), DeviceError);
  device.stop();
  device.stop();
  device.start(ticks.tick());
  device.stop();
}

TEST_CASE("a lost device has zero force before the loop gets its one unhealthy sample") {
  Ticks ticks;
  Bare device;
  device.lost = true;
  device.start(ticks.tick());
  while (!device.finished()) std::this_thread::yield();
  CHECK(ticks.healthy == 1);
  CHECK(ticks.unhealthy == 1);
  CHECK(device.last == Tick::Force{0, 0, 0});
}

TEST_CASE("if a tick does not return, stop() gives zero force without it, and its force is never written") {
  HangingTick model(3);
  Bare device;
  device.start(model.tick());
  REQUIRE(soon([&] { return model.calls == 3; }));
  CHECK(device.last == Tick::Force{0, 1, 0});
  std::thread stops([&] { device.stop(); });
  CHECK(soon([&] { return device.ends == 1; }));
  CHECK(device.last == Tick::Force{0, 0, 0});
  model.returns = true;
  stops.join();
  CHECK(device.last == Tick::Force{0, 0, 0});
  CHECK(device.ends == 1);
  CHECK(model.calls == 3);
  device.start(model.tick());
  CHECK(soon([&] { return model.calls >= 5; }));
  device.stop();
  CHECK(device.ends == 2);
}

TEST_CASE("a reading that comes long after stop() leads to zero force, though a tick would not return") {
  struct SlowToRead : Bare {
    ~SlowToRead() override { stop(); }
    Next read() noexcept override {
      while (!may_read) std::this_thread::yield();
      return Bare::read();
    }
    std::atomic<bool> may_read{false};
  };
  HangingTick model(1);
  SlowToRead device;
  device.start(model.tick());
  std::thread stops([&] { device.stop(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // stop() has most often waited long enough by then
  device.may_read = true;
  CHECK(soon([&] { return device.ends == 1; }));
  model.returns = true;
  stops.join();
  CHECK(device.last == Tick::Force{0, 0, 0});
}

TEST_CASE("the thread itself requests real-time scheduling, before the preparation") {
  Ticks ticks;
  Bare device({true, false, {80, -1, false, false}});
  device.start(ticks.tick());
  device.stop();
  CHECK(device.known > 0);
  CHECK(device.known == device.statements().size());
}
