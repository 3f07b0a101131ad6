// Linux.
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "punctura_runtime/os/os.hpp"

namespace punctura::os {

std::int64_t now_ns() noexcept {
  timespec t;
  clock_gettime(CLOCK_BOOTTIME, &t);  // CLOCK_MONOTONIC stands still while the computer sleeps
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

void sleep_until_ns(std::int64_t time) noexcept {
  const timespec t{static_cast<time_t>(time / 1'000'000'000), static_cast<long>(time % 1'000'000'000)};
  while (clock_nanosleep(CLOCK_BOOTTIME, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

namespace {

RealtimeItem item(std::string what, int error, const char* advice) {
  if (error == 0) return {std::move(what), true, ""};
  return {std::move(what), false, std::string(std::strerror(error)) + "; " + advice};
}

/// Keeps the processors awake: the kernel does that while this file is open with a latency of 0 us written to it. Never
/// closed.
int keep_awake() {
  static const int result = [] {
    const int file = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const std::int32_t latency_us = 0;
    return ::write(file, &latency_us, sizeof latency_us) == sizeof latency_us ? 0 : errno;
  }();
  return result;
}

struct Mapping {
  std::uintptr_t begin, end;
  bool executable;
  std::string file;
};

/// All readable mappings of files in this process.
std::vector<Mapping> mappings() {
  std::vector<Mapping> all;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    Mapping m{};
    char dash;
    std::string permissions, offset, device, inode;
    if (words >> std::hex >> m.begin >> dash >> m.end >> permissions >> offset >> device >> inode >> m.file &&
        permissions[0] == 'r' && m.file[0] == '/') {
      m.executable = permissions[2] == 'x';
      all.push_back(std::move(m));
    }
  }
  return all;
}

/// Loads and locks the program and its libraries as a whole: code that only a fault runs would otherwise be on the disk
/// until then. Errors are ignored here, since lock_memory() reports them.
void bring_in_programs() {
  const auto all = mappings();
  std::set<std::string> programs;
  for (const Mapping& m : all)
    if (m.executable) programs.insert(m.file);
  for (const Mapping& m : all)
    if (programs.count(m.file) != 0) mlock(reinterpret_cast<const void*>(m.begin), m.end - m.begin);
}

/// Other pages are locked when they are first used: the allocators of some libraries reserve a gigabyte that they never
/// use.
int lock_memory() {
  static const bool once = (bring_in_programs(), true);
  static_cast<void>(once);
  return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
}

}  // namespace

std::vector<RealtimeItem> make_realtime(const RealtimeSettings& settings) {
  std::vector<RealtimeItem> items;
  if (settings.priority > 0) {
    sched_param parameter{};
    parameter.sched_priority = settings.priority;
    items.push_back(item("SCHED_FIFO real-time priority " + std::to_string(settings.priority),
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
