// A computer that sleeps during a run: its clocks are replaced here, for the whole test program.
#ifdef __linux__
#include <doctest/doctest.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

#include "core/support/tick.hpp"
#include "punctura_runtime/backends/fed.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

namespace {
std::atomic<long> slept_s{0};
}

/// Linux's clocks, of which CLOCK_MONOTONIC stands still while the computer sleeps.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long result = syscall(SYS_clock_gettime, clock, time);
  if (clock == CLOCK_BOOTTIME) time->tv_sec += slept_s;
  return static_cast<int>(result);
}

using namespace punctura;
using namespace punctura::test;

TEST_CASE("the first tick after the computer slept is a fault, though the hand did not move") {
  DeviceInfo info;
  info.rate = 1600;
  auto device = std::make_shared<FedDevice>(info);
  LoopSettings settings;
  settings.gate.deadline = settings.gate.stale = 600;  // a busy computer is not late
  ServoLoop loop(device, paper_scene(), settings);
  loop.start();
  loop.arm();
  for (int k = 0; k <= 3200; ++k) device->feed({{0, 2e-3 - 1e-6 * k, 0}});
  CHECK(loop.latest().fault == Fault::none);
  CHECK(loop.latest().force[1] > 0.2);
  slept_s = 2000;  // within the loop's own five deadlines: the tick comes first
  const Tick::Force force = device->feed({{0, 2e-3 - 3200e-6, 0}});
  slept_s = 0;
  CHECK(force == zero);
  CHECK(loop.latest().fault == Fault::missed_deadline);
}
#endif
