// All that differs between operating systems. linux.cpp, windows.cpp and macos.cpp implement it; posix_library.cpp is
// shared by Linux and macOS.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace punctura::os {

/// A monotonic clock, ns. It goes on while the computer sleeps: the first tick after that is late, which is a fault.
std::int64_t now_ns() noexcept;

/// Sleeps until that time of now_ns(). May wake late, never early.
void sleep_until_ns(std::int64_t time) noexcept;

/// A request to the system, and whether it was granted, for the user.
struct RealtimeItem {
  std::string what;
  bool granted;
  std::string detail;  ///< why it was refused, and how to allow it
};

struct RealtimeSettings {
  int priority = 80;        ///< real-time priority under SCHED_FIFO, 1 to 99; 0: none
  int processor = -1;       ///< the processor to run on; -1: any
  bool lock_memory = true;  ///< no page of memory is swapped out
  bool awake = true;        ///< the processor does not sleep between ticks
  double period = 1e-3;     ///< s, of the ticks; used by macOS only

  /// The same settings for a loop at this rate, Hz. An unknown rate leaves the period.
  RealtimeSettings at_rate(double rate) const noexcept {
    RealtimeSettings settings = *this;
    if (std::isfinite(rate) && rate > 0) settings.period = 1 / rate;
    return settings;
  }
};

/// The parameters of a time-constraint thread of macOS, ns: its period, its computing time, and the latest end after
/// its wake-up.
struct TimeConstraint {
  std::int64_t period, computation, constraint;

  /// period: s. The system refuses a computation below 50 us, and a constraint below the computation.
  static TimeConstraint of(double period) noexcept {
    const auto ns = static_cast<std::int64_t>(period * 1e9);
    constexpr std::int64_t computation = 60'000, latest = 300'000;
    const std::int64_t half = ns / 2 < latest ? ns / 2 : latest;
    return {ns, computation, half > computation ? half : computation};
  }
};

/// Requests real-time scheduling for the calling thread. Refused requests are reported and do no harm.
std::vector<RealtimeItem> make_realtime(const RealtimeSettings& settings);

/// Adds one line for each, for Device::statements().
inline void add_words(const std::vector<RealtimeItem>& items, std::vector<std::string>& lines) {
  for (const RealtimeItem& item : items)
    lines.push_back(item.what + (item.granted ? ": granted" : ": not granted, " + item.detail));
}

/// Loads a shared library for the rest of the process. nullptr if it does not load; `error` then says why.
void* load_library(const char* name, std::string& error);
/// nullptr if the library has no such symbol.
void* library_symbol(void* library, const char* name) noexcept;

#ifdef _WIN32
/// error: of GetLastError() or WSAGetLastError(). Without the full stop and the line break that Windows adds.
std::string windows_words(unsigned long error);
#endif

}  // namespace punctura::os
