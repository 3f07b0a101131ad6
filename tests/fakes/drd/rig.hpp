// A loop on a Force Dimension device of the fake library. The test advances the fake's time.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "core/support/paper_scene.hpp"
#include "fakes/drd/fake_drd.hpp"
#include "punctura_runtime/backends/force_dimension/device.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

namespace punctura::test {

/// The controls of a fake library. One that lacks a control was not built from tests/fakes/drd.
struct FakeDrd : fake_drd::Control {
  explicit FakeDrd(const std::string& path) {
    const LoadedLibrary loaded = load_makers_library({}, path,
                                                     {{"fake_drd_reset", reset},
                                                      {"fake_drd_virtual_time", virtual_time},
                                                      {"fake_drd_now", now},
                                                      {"fake_drd_advance", advance},
                                                      {"fake_drd_strokes", strokes},
                                                      {"fake_drd_target", target},
                                                      {"fake_drd_buttons", buttons},
                                                      {"fake_drd_inject", inject},
                                                      {"fake_drd_report", report}});
    if (loaded.state != BackendStatus::State::available) throw std::runtime_error(loaded.detail);
  }
  fake_drd::Report state() const {
    fake_drd::Report report_now{};
    report(&report_now);
    return report_now;
  }
};

inline FakeDrd& fake() {
  static FakeDrd one(PUNCTURA_FAKE_DRD);
  return one;
}

/// Here the device's thread sleeps until the test advances the fake's time to its next tick.
class CrankedClock {
 public:
  static LoopClock clock() { return {&CrankedClock::now, &CrankedClock::sleep_until}; }

  static void reset() {
    auto& s = state();
    const std::lock_guard lock(s.mutex);
    s.limit = fake().now();
    s.asked = s.stall = 0;
    s.free = false;
  }
  /// Makes all ticks that are due until then. Afterwards the thread waits.
  static void run_to(std::int64_t time, const force_dimension::ForceDimensionDevice& device) {
    auto& s = state();
    {
      std::unique_lock lock(s.mutex);
      s.limit = time;
      s.wake.notify_all();
      while (s.asked <= time && !device.finished()) s.wake.wait_for(lock, std::chrono::milliseconds(1));
    }
    fake().advance(time);
  }
  /// Makes the next wake-up late by this time.
  static void stall(std::int64_t ns) {
    const std::lock_guard lock(state().mutex);
    state().stall = ns;
  }
  /// Lets time run as fast as possible, for stop().
  static void release() {
    auto& s = state();
    const std::lock_guard lock(s.mutex);
    s.free = true;
    s.wake.notify_all();
  }

 private:
  struct State {
    std::mutex mutex;
    std::condition_variable wake;
    std::int64_t limit = 0, asked = 0, stall = 0;
    bool free = false;
  };
  static State& state() {
    static State one;
    return one;
  }
  static std::int64_t now() noexcept { return fake().now(); }
  static void sleep_until(std::int64_t time) noexcept {
    auto& s = state();
    std::unique_lock lock(s.mutex);
    s.asked = time;
    s.wake.notify_all();
    s.wake.wait(lock, [&] { return s.free || time <= s.limit; });
    fake().advance(time + std::exchange(s.stall, 0));
  }
};

/// An omega.6 whose handle points down, over the membrane of K06 section 4.
inline fake_drd::Settings upright() {
  fake_drd::Settings settings;
  settings.system_type = 34;
  settings.wrist = 1;
  const double frame[3][3] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) settings.frame[r][c] = frame[r][c];
  return settings;
}

class FakeRig {
 public:
  explicit FakeRig(const fake_drd::Settings& settings = upright(), double rate = 1600, Scene scene = paper_scene(),
                   LoopSettings limits = {}, std::size_t listen = 0)
      : made_(prepared(settings)), device(open(rate)), loop(device, std::move(scene), without_silence(limits)) {
    if (listen > 0) ring = &loop.listen(listen);
  }
  ~FakeRig() { stop(); }

  /// Seconds of the fake's time.
  void run(double seconds) {
    time_ += static_cast<std::int64_t>(seconds * 1e9);
    CrankedClock::run_to(time_, *device);
  }
  void start() { CrankedClock::reset(), loop.start(), time_ = fake().now(); }
  void stop() { CrankedClock::release(), loop.stop(); }
  /// Arms outside, then pushes the needle in until there is force.
  void push_in() {
    loop.arm();
    start();
    run(0.1);
    fake().target(0, 0, -4e-3);
    run(0.7);
  }
  std::int64_t time() const { return time_; }

 private:
  /// The loop's own clock stands still: between two calls of run() the ticks wait for the test, and that is no silence.
  static LoopSettings without_silence(LoopSettings limits) {
    limits.now_ns = []() noexcept -> std::int64_t { return 1; };
    return limits;
  }
  static bool prepared(const fake_drd::Settings& settings) {
    fake().reset(&settings);
    fake().virtual_time(1);
    return true;
  }
  static std::shared_ptr<force_dimension::ForceDimensionDevice> open(double rate) {
    force_dimension::Options options;
    options.rate = rate;
    options.library = PUNCTURA_FAKE_DRD;
    options.clock = CrankedClock::clock();
    options.realtime = {0, -1, false, false};
    return std::make_shared<force_dimension::ForceDimensionDevice>(options);
  }

  bool made_;
  std::int64_t time_ = 0;

 public:
  std::shared_ptr<force_dimension::ForceDimensionDevice> device;
  ServoLoop loop;
  SnapshotRing* ring = nullptr;
};

}  // namespace punctura::test
