// The library's stack of errors, one a process: whoever polls it takes them from everybody else. So while ticks come, only the tick
// does.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"
#include "punctura_runtime/backends/openhaptics/hd_words.hpp"

namespace punctura::hd {

/// How often the device limited its own force: warm motors, force, rise of force, speed.
struct Warnings {
  std::array<std::atomic<std::uint64_t>, 4> counts{};

  void count(std::uint32_t code) noexcept { counts[code - warm_motors].fetch_add(1, std::memory_order_relaxed); }
};

/// Takes all errors off the stack, the newest first. The oldest that is not a warning is the cause of the others and is given back.
inline ErrorInfo take_errors(const Interface& hd, Warnings& warnings) noexcept {
  ErrorInfo cause{success, 0, no_device};
  for (int i = 0; i < 64; ++i) {  // a library that never says success must not hold the tick
    const ErrorInfo error = hd.get_error();
    if (error.code == success) break;
    if (is_warning(error.code))
      warnings.count(error.code);
    else
      cause = error;
  }
  return cause;
}

inline ErrorInfo take_errors(const Interface& hd) noexcept {
  Warnings ignored;
  return take_errors(hd, ignored);
}

}  // namespace punctura::hd
