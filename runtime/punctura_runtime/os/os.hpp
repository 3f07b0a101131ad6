// Everything that differs from one operating system to the next. One file each implements it: linux.cpp, windows.cpp, macos.cpp;
// what Linux and macOS share stands in posix_*.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace punctura::os {

/// Nanoseconds on a clock that never goes back.
std::int64_t now_ns() noexcept;

/// Sleeps until that time on now_ns(). May wake late, never early.
void sleep_until_ns(std::int64_t time) noexcept;

/// What was asked of the scheduler and what came of it, in words for a person.
struct RealtimeItem {
  std::string what;
  bool granted;
  std::string detail;  ///< why not, and how to allow it
};

struct RealtimeSettings {
  int priority = 80;        ///< real-time priority under SCHED_FIFO, 1 to 99; 0 asks for none
  int processor = -1;       ///< the one to stay on; -1 is any
  bool lock_memory = true;  ///< no page of ours is put aside
  bool awake = true;        ///< the processor does not go to sleep between ticks
  double period = 1e-3;     ///< s, from one tick to the next; macOS plans the thread by it

  /// The same for a loop of this rate, Hz. A rate that is not known leaves the period.
  RealtimeSettings at_rate(double rate) const noexcept {
    RealtimeSettings settings = *this;
    if (std::isfinite(rate) && rate > 0) settings.period = 1 / rate;
    return settings;
  }
};

/// What macOS is told of a thread that ticks, ns: how often, how long it computes, and within what time from its wake-up.
struct TimeConstraint {
  std::int64_t period, computation, constraint;

  /// For a period in s. The system refuses a computation below 50 us and a constraint below the computation.
  static TimeConstraint of(double period) noexcept {
    const auto ns = static_cast<std::int64_t>(period * 1e9);
    constexpr std::int64_t computation = 60'000, latest = 300'000;
    const std::int64_t half = ns / 2 < latest ? ns / 2 : latest;
    return {ns, computation, half > computation ? half : computation};
  }
};

/// Makes the calling thread as punctual as the system allows. What it does not allow is said, and does no harm.
std::vector<RealtimeItem> make_realtime(const RealtimeSettings& settings);

/// A line each, as Device::statements() has them.
inline void add_words(const std::vector<RealtimeItem>& items, std::vector<std::string>& lines) {
  for (const RealtimeItem& item : items)
    lines.push_back(item.what + (item.granted ? ": granted" : ": not granted, " + item.detail));
}

/// Loads a shared library for the rest of the process. nullptr if it does not load; `error` then says why.
void* load_library(const char* name, std::string& error);
/// nullptr if the library has no such symbol.
void* library_symbol(void* library, const char* name) noexcept;

}  // namespace punctura::os
