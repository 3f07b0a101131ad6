// A tick that does not return, through the whole loop.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "core/support/tick.hpp"
#include "punctura_runtime/backends/fed.hpp"
#include "punctura_runtime/backends/polled_device.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"
#include "runtime/support/soon.hpp"
#include "runtime/support/stuck_in_stop.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

std::atomic<std::int64_t> hang_clock_ns{0};
constexpr std::int64_t second_ns = 1'000'000'000;

DeviceInfo fed_info() {
  DeviceInfo info;
  info.rate = 1600;
  return info;
}

/// Holds the needle with `grip`. Where `hangs` is set, its tick does not return.
struct HangingLaw {
  using Scalar = double;
  struct Memory {};
  static inline std::atomic<bool> hangs{false}, in_tick{false};
  static inline std::atomic<double> grip{0.3};  ///< N
  static LoopSettings settings(std::shared_ptr<ThumbLoop> thumb = {}) {
    hangs = in_tick = false;
    grip = 0.3;
    hang_clock_ns = second_ns;
    LoopSettings made;
    made.thumb = std::move(thumb);
    made.now_ns = []() noexcept { return hang_clock_ns.load(); };
    made.model = StepMaker::with_laws([](auto&&...) { return HangingLaw{}; });
    return made;
  }
  PiecewiseBand<double, 2> pieces(double, const Memory&) const noexcept {
    const double most = grip;
    return {{0}, {{{}, {0, {-most}, {most}}}}};
  }
  bool advance(Memory&, double) const noexcept {
    while (hangs) in_tick = true;
    return false;
  }
};

/// Goes 5 mm into the tissue, and stays there.
struct HeldDevice : PolledDevice {
  HeldDevice() {
    info_.rate = 1600;
    pacing_ = {false, false};
  }
  ~HeldDevice() override { stop(); }
  Next read() noexcept override {
    sample_.sequence = count();
    sample_.time = now();
    sample_.position[1] = std::max(2e-3 - 5e-3 * sample_.time, -5e-3);
    return Next::tick;
  }
  Next write(const Tick::Force& force) noexcept override { return upwards = force[1], Next::tick; }
  void end() noexcept override { upwards = 0; }
  std::atomic<double> upwards{0};
};

}  // namespace

TEST_CASE("if a law does not return from a tick, the loop's thread ends the force, and the run when it returns") {
  struct Stopped : FedDevice {
    using FedDevice::FedDevice;
    void stop() noexcept override {
      FedDevice::stop();
      stopped = true;
    }
    std::atomic<bool> stopped{false};
  };
  const auto device = std::make_shared<HeldDevice>();
  const auto under = std::make_shared<Stopped>(fed_info(), false);
  ServoLoop loop(device, paper_scene(), HangingLaw::settings(std::make_shared<ThumbLoop>(under)));
  loop.arm();
  loop.start();
  REQUIRE(soon([&] { return device->upwards > 0.25; }));
  HangingLaw::hangs = true;
  REQUIRE(soon([&] { return HangingLaw::in_tick.load(); }));
  CHECK(device->upwards > 0.25);  // the device holds it
  CHECK(soon([&] { return hang_clock_ns += second_ns / 100, device->upwards == 0; }));
  CHECK(loop.over());
  CHECK(loop.running());
  CHECK(under->stopped);
  HangingLaw::hangs = false;
  CHECK(soon([&] { return !loop.running(); }));
  CHECK(device->upwards == 0);
  CHECK(loop.silence().find("ticks have ceased") != std::string::npos);
}

TEST_CASE("a tick that returns after the stop gives and records no force; the budget counts the force before") {
  struct Waiting : HandCranked {
    void stop() noexcept override {
      stopping = true;
      if (ticking.joinable()) ticking.join();
      HandCranked::stop();
    }
    std::atomic<bool> stopping{false};
    std::thread ticking;
  };
  const auto device = std::make_shared<Waiting>();
  ServoLoop loop(device, paper_scene(), HangingLaw::settings());
  HangingLaw::grip = 1.5;
  loop.arm();
  loop.start();
  device->move(2e-3, 1e-3, 1600);
  const double held = device->move(1e-3, -9e-3, 400)[1];
  REQUIRE(held > 1.2);
  const std::uint64_t ticks = loop.report().ticks;

  HangingLaw::grip = 0.1;
  HangingLaw::hangs = true;
  Tick::Force late{1, 1, 1};
  device->ticking = std::thread([&] { late = device->tick(-9e-3); });
  CHECK(soon([&] { return HangingLaw::in_tick.load(); }));
  std::thread stops([&] { loop.stop(); });
  CHECK(soon([&] { return device->stopping.load(); }));
  hang_clock_ns += 2 * second_ns;
  HangingLaw::hangs = false;
  stops.join();
  CHECK(late == zero);
  CHECK(loop.report().ticks == ticks);
  CHECK(loop.latest().force[1] == held);
  CHECK(device->motor_use.spent > 2 * (held * held - 0.75 * 0.88 * 0.88));
}

TEST_CASE("a loop whose stop does not return leaves no other loop of the program with force") {
  const auto stuck = std::make_shared<StuckInStop>(fed_info(), false);
  const auto device = std::make_shared<FedDevice>(fed_info(), false);
  ServoLoop first(stuck, paper_scene()), second(device, paper_scene());
  first.start();
  second.arm();
  second.start();
  Tick::Force force{};
  for (int k = 0; k < 4800; ++k) force = device->feed({{0, 2e-3 - 2e-6 * std::min(k, 3200), 0}});
  REQUIRE(force[1] > 0.3);
  std::thread ends([] { ServoLoop::stop_all(); });
  CHECK(soon([&] { return device->feed({{0, -4.4e-3, 0}}) == zero; }));
  CHECK(second.running());
  stuck->released = true;
  ends.join();
  CHECK_FALSE(second.running());
}
