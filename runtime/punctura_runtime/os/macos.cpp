// macOS. Written from Apple's documents; not yet run (docs/realtime.md).
#include <mach/mach.h>
#include <mach/mach_error.h>
#include <mach/mach_time.h>
#include <mach/thread_policy.h>
#include <sys/mman.h>
#include <time.h>

#include <cerrno>
#include <cstring>

#include "punctura_runtime/os/os.hpp"

namespace punctura::os {

namespace {

/// The unit of Mach's clock.
mach_timebase_info_data_t timebase() noexcept {
  static const mach_timebase_info_data_t info = [] {
    mach_timebase_info_data_t i;
    mach_timebase_info(&i);
    return i;
  }();
  return info;
}

std::uint64_t ticks_from_ns(std::int64_t ns) noexcept {
  return static_cast<std::uint64_t>(ns) * timebase().denom / timebase().numer;
}

}  // namespace

std::int64_t now_ns() noexcept {  // mach_absolute_time() stands still while the computer sleeps
  return static_cast<std::int64_t>(mach_continuous_time() * timebase().numer / timebase().denom);
}

void sleep_until_ns(std::int64_t time) noexcept {
  if (const std::int64_t left = time - now_ns(); left > 0) mach_wait_until(mach_absolute_time() + ticks_from_ns(left));
}

std::vector<RealtimeItem> make_realtime(const RealtimeSettings& settings) {
  std::vector<RealtimeItem> items;
  if (settings.priority > 0) {
    // macOS has no SCHED_FIFO for a program's threads. Its audio uses time-constraint threads.
    thread_time_constraint_policy_data_t policy{};
    const TimeConstraint wanted = TimeConstraint::of(settings.period);
    policy.period = static_cast<std::uint32_t>(ticks_from_ns(wanted.period));
    policy.computation = static_cast<std::uint32_t>(ticks_from_ns(wanted.computation));
    policy.constraint = static_cast<std::uint32_t>(ticks_from_ns(wanted.constraint));
    policy.preemptible = 1;
    const kern_return_t result =
        thread_policy_set(mach_thread_self(), THREAD_TIME_CONSTRAINT_POLICY, reinterpret_cast<thread_policy_t>(&policy),
                          THREAD_TIME_CONSTRAINT_POLICY_COUNT);
    items.push_back({"time-constraint thread, every " + std::to_string(wanted.period / 1000) + " us",
                     result == KERN_SUCCESS, result == KERN_SUCCESS ? "" : mach_error_string(result)});
  }
  if (settings.processor >= 0)
    items.push_back({"processor " + std::to_string(settings.processor), false,
                     "macOS does not let a thread stay on one processor"});
  if (settings.lock_memory) {
    const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    items.push_back({"memory locked", locked, locked ? "" : std::strerror(errno)});
  }
  return items;
}

}  // namespace punctura::os
