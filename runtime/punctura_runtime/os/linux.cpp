// Linux.
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "punctura_runtime/os/os.hpp"

namespace punctura::os {

std::int64_t now_ns() noexcept {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

void sleep_until_ns(std::int64_t time) noexcept {
  const timespec t{static_cast<time_t>(time / 1'000'000'000), static_cast<long>(time % 1'000'000'000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

namespace {

RealtimeItem item(std::string what, int error, const char* advice) {
  if (error == 0) return {std::move(what), true, ""};
  return {std::move(what), false, std::string(std::strerror(error)) + "; " + advice};
}

/// The kernel keeps processors awake as long as this file is open with a latency of 0 us in it: once a process, for ever.
int keep_awake() {
  static const int result = [] {
    const int file = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const std::int32_t latency_us = 0;
    return ::write(file, &latency_us, sizeof latency_us) == sizeof latency_us ? 0 : errno;
  }();
  return result;
}

/// The first time, everything there is is brought in; from then on, a page stays from its first use on. Without that difference,
/// each new run would bring in the gigabyte that an allocator of a library has reserved meanwhile, and never uses.
int lock_memory() {
  static const int refused = mlockall(MCL_CURRENT) == 0 ? 0 : errno;
  if (refused != 0) return refused;
  return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
}

}  // namespace

std::vector<RealtimeItem> make_realtime(const RealtimeSettings& settings) {
  std::vector<RealtimeItem> items;
  if (settings.priority > 0) {
    sched_param parameter{};
    parameter.sched_priority = settings.priority;
    items.push_back(item("first-in-first-out priority " + std::to_string(settings.priority),
                         pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter),
                         "allow it with 'rtprio 99' for your group in /etc/security/limits.conf"));
  }
  if (settings.processor >= 0) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<unsigned>(settings.processor), &set);
    items.push_back(item("processor " + std::to_string(settings.processor),
                         pthread_setaffinity_np(pthread_self(), sizeof set, &set), "name one that exists"));
  }
  if (settings.lock_memory)
    items.push_back(
        item("memory locked", lock_memory(), "allow it with 'memlock unlimited' in /etc/security/limits.conf"));
  if (settings.awake) items.push_back(item("processor kept awake", keep_awake(), "allow writing /dev/cpu_dma_latency"));
  return items;
}

}  // namespace punctura::os
