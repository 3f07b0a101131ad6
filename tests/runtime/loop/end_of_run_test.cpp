// A run that ends by itself: after its duration, and where ticks cease.
#include <doctest/doctest.h>
#ifdef __linux__
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <atomic>
#include <chrono>
#include <thread>

#include "core/support/tick.hpp"
#include "punctura_runtime/backends/fed.hpp"
#include "punctura_runtime/backends/replay.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"
#include "runtime/support/soon.hpp"
#include "runtime/support/stuck_in_stop.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

std::atomic<std::int64_t> run_clock_ns{0};
constexpr std::int64_t one_second = 1'000'000'000;

std::shared_ptr<FedDevice> fed_device(bool real_time) {
  DeviceInfo info;
  info.rate = 1600;
  return std::make_shared<FedDevice>(info, real_time);
}

/// A loop on the test's clock, whose gate takes a late tick for no fault.
struct WatchedRun {
  explicit WatchedRun(std::shared_ptr<Device> device, std::shared_ptr<ThumbLoop> thumb = {})
      : loop(std::move(device), paper_scene(), settings(std::move(thumb))) {}
  static LoopSettings settings(std::shared_ptr<ThumbLoop> thumb) {
    run_clock_ns = one_second;
    LoopSettings made;
    made.thumb = std::move(thumb);
    made.now_ns = []() noexcept { return run_clock_ns.load(); };
    return made;
  }
  bool stopped() {
    return soon([&] { return !loop.running(); });
  }
  ServoLoop loop;
};

/// A device without a tick, at which the loop's thread looks.
struct WatchedDevice : FedDevice {
  WatchedDevice() : FedDevice(fed_device(true)->info()) {}
  LongestSilence longest_silence() const noexcept override {
    ++looks;
    return FedDevice::longest_silence();
  }
  /// Waits until the loop has looked once with the present time. False after a minute, and when the run has ended.
  bool looked_at() const {
    const int third = looks + 3;  // the first may have begun before, and the second has ended when the third begins
    return soon([&] { return looks >= third; });
  }
  mutable std::atomic<int> looks{0};
};

}  // namespace

TEST_CASE("after its duration a run gives no force and records no tick, and its device is stopped") {
  auto device = fed_device(false);
  WatchedRun w(device);
  SnapshotRing& ring = w.loop.listen(10'000);
  for (unsigned run = 0; run < 2; ++run) {
    w.loop.arm();
    w.loop.start(3.0);
    bool felt = false, after = false;
    for (int k = 0; k < 6400; ++k) {
      const bool ended = run_clock_ns >= (1 + 4 * run + 3) * one_second;
      const Tick::Force force = device->feed({{0, 2e-3 - 2e-6 * std::min(k, 3200), 0}});
      felt = felt || force[1] > 0.3;
      after = after || (ended && force != zero);
      run_clock_ns += one_second / 1600;
    }
    CHECK(felt);
    CHECK_FALSE(after);
    CHECK(w.stopped());
    CHECK(w.loop.over());
    CHECK(w.loop.silence().empty());
    CHECK(w.loop.report().ticks == 4800 * (run + 1));
    std::size_t recorded = 0;
    ring.pop(10'000, [&](const Snapshot&) { ++recorded; });
    CHECK(recorded == 4800);
  }
}

TEST_CASE("a loop stops a device whose ticks cease, and says so") {
  auto device = fed_device(true);
  WatchedRun w(device);
  w.loop.start();
  run_clock_ns += 29 * one_second;
  CHECK_FALSE(w.loop.over());
  device->feed({{0, 1e-3, 0}});
  CHECK(soon([&] {
    run_clock_ns += one_second / 20;
    return !w.loop.running();
  }));
  CHECK(w.loop.silence().starts_with("the device's ticks have ceased, for "));
  CHECK(w.loop.silence().ends_with(" s, and the run is stopped: should the device still pull, switch it off"));
  w.loop.start();  // without a first reading
  CHECK(w.loop.silence().empty());
  CHECK_FALSE(w.loop.over());
  run_clock_ns += 31 * one_second;
  CHECK(w.stopped());
  CHECK(w.loop.silence().find("for 31 s") != std::string::npos);
}

TEST_CASE("a silent second device ends the run, too") {
  auto needle = fed_device(false), under = fed_device(true);
  WatchedRun w(needle, std::make_shared<ThumbLoop>(under));
  w.loop.start();
  run_clock_ns += 31 * one_second;
  CHECK(w.stopped());
  CHECK(w.loop.silence().starts_with("the second device's ticks have ceased"));
}

TEST_CASE("a second device may be silent for five of its own deadlines") {
  auto under = std::make_shared<WatchedDevice>();
  ThumbSettings slow;
  slow.gate.deadline = 10;
  WatchedRun w(fed_device(false), std::make_shared<ThumbLoop>(under, slow));
  w.loop.start();
  run_clock_ns += 49 * one_second;
  CHECK(under->looked_at());
  CHECK_FALSE(w.loop.over());
  run_clock_ns += 2 * one_second;
  CHECK(w.stopped());
}

TEST_CASE("a device that takes long to start was not silent meanwhile") {
  struct SlowToStart : WatchedDevice {
    void start(Tick tick) override {
      run_clock_ns += 60 * one_second;
      WatchedDevice::start(tick);
    }
  };
  auto device = std::make_shared<SlowToStart>();
  WatchedRun w(device);
  w.loop.start();
  CHECK(device->looked_at());
  CHECK_FALSE(w.loop.over());
  run_clock_ns += 31 * one_second;
  CHECK(w.stopped());
}

TEST_CASE("a run begins though nobody has noticed yet that the one before is over") {
  auto device = fed_device(false);
  WatchedRun w(device);
  for (std::uint64_t run = 1; run <= 3; ++run) {
    w.loop.start(3.0);
    device->feed({{0, 1e-3, 0}});
    CHECK(w.loop.report().ticks == run);
    run_clock_ns += 3 * one_second;
  }
}

TEST_CASE("a duration is a number of 0 or more") {
  WatchedRun w(fed_device(false));
  for (const double wrong : {-1.0, not_given}) CHECK_THROWS_AS(w.loop.start(wrong), std::invalid_argument);
  CHECK_FALSE(w.loop.running());
}

#ifdef __linux__
TEST_CASE("the thread that watches has real-time priority, where the system grants it") {
  bool granted = false;
  std::thread([&] { granted = os::make_realtime(WatchThread::priority).at(0).granted; }).join();
  std::atomic<int> policy{-1};
  WatchThread watch;
  watch.start([&] {
    policy = sched_getscheduler(0);
    return false;
  });
  CHECK(soon([&] { return policy != -1; }));
  CHECK(policy == (granted ? SCHED_FIFO : SCHED_OTHER));
}

TEST_CASE("the child of a fork during a run can destroy the loop, and ends") {
  auto device = std::make_shared<WatchedDevice>();
  auto run = std::make_unique<WatchedRun>(device);
  run->loop.start();
  CHECK(device->looked_at());
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);  // ends a child that hangs
    run.reset();
    _exit(7);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}
#endif

TEST_CASE("the longest silence: of hardware, of a deadline, of a device that nobody holds") {
  TickWatch watch;
  const auto silent_after = [&](double seconds, const LongestSilence& longest, double deadline) {
    watch.begin(7, 0);
    CHECK(watch.silent(8, one_second, longest, deadline) == 0);
    return watch.silent(8, one_second + static_cast<std::int64_t>(seconds * 1e9), longest, deadline) > 0;
  };
  const LongestSilence hardware = HandCranked().Device::longest_silence();
  CHECK_FALSE(silent_after(0.099, hardware, 0.02));
  CHECK(silent_after(0.1001, hardware, 0.02));
  CHECK_FALSE(silent_after(0.49, hardware, 0.1));
  CHECK(silent_after(0.51, hardware, 0.1));
  CHECK_FALSE(silent_after(1e6, SimulatedDevice(Target({}), {}).longest_silence(), 0.02));
  CHECK_FALSE(silent_after(1e6, ReplayDevice({}, fed_device(true)->info()).longest_silence(), 0.02));
  CHECK_FALSE(silent_after(1e6, fed_device(false)->longest_silence(), 0.02));
}

TEST_CASE("a driver whose stop does not return hides neither the end nor its reason") {
  auto device = std::make_shared<StuckInStop>(fed_device(true)->info());
  WatchedRun w(device);
  w.loop.start();
  run_clock_ns += 31 * one_second;
  CHECK(soon([&] { return w.loop.over(); }));
  CHECK_FALSE(w.loop.silence().empty());
  device->released = true;
  CHECK(w.stopped());
}

TEST_CASE("run() arms, and ends with the device's last tick or with a fault") {
  const StrokesMotion once({{0, 5e-3, 0}, {0, -9e-3, 0}, 1, 0.5, 0.5, 0}, 1);
  SimulatedOptions options;
  options.real_time = false;
  for (const std::uint64_t ticks : {3200U, 0U}) {  // 0: endless
    options.ticks = ticks;
    const auto device = std::make_shared<SimulatedDevice>(once, options);
    if (ticks == 0) device->spoil([](DeviceSample& sample) { sample.healthy = false; });
    ServoLoop loop(device, paper_scene());
    SnapshotRing& felt = loop.listen(3200);
    loop.run();
    CHECK_FALSE(loop.running());
    double largest = 0;
    felt.pop(3200, [&](const Snapshot& s) { largest = std::max(largest, s.force[1]); });
    CHECK((largest > 0.1) == (ticks != 0));
    CHECK(loop.latest().fault == (ticks != 0 ? Fault::none : Fault::device));
    if (ticks != 0) CHECK(loop.report().ticks == ticks);
  }
}
