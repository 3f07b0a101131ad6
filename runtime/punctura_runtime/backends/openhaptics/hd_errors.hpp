// The HD library's errors: what they mean, and their stack. There is one stack for the process, and reading it empties
// it. So while ticks run, only the tick reads it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

namespace punctura::hd {

/// The device limits its own force and continues: counted, not a reason to stop.
constexpr bool is_warning(std::uint32_t code) noexcept { return code >= warm_motors && code <= exceeded_max_velocity; }

/// "COMM_ERROR (0x302, internal -28): the link to the device broke ..."
std::string describe(const ErrorInfo& error);

/// How the user calibrates such a device.
std::string how_to_calibrate(std::uint32_t styles);

/// Counts how often the device limited its own force: warm motors, force, rise of force, speed.
struct Warnings {
  std::array<std::atomic<std::uint64_t>, 4> counts{};

  void count(std::uint32_t code) noexcept { counts[code - warm_motors].fetch_add(1, std::memory_order_relaxed); }
};

/// Empties the stack, newest error first. Returns the oldest that is not a warning: it caused the others.
inline ErrorInfo take_errors(const Interface& hd, Warnings& warnings) noexcept {
  ErrorInfo cause{success, 0, no_device};
  for (int i = 0; i < 64; ++i) {  // bounded, in case the library never returns `success`
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
