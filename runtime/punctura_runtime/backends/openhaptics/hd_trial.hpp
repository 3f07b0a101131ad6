// The scheduler, run for a short time without force: at what rate it really calls, and whether the device knows where it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "punctura_runtime/backends/openhaptics/hd_session.hpp"

namespace punctura::hd {

struct Trial {
  unsigned long set;              ///< Hz, as the library took it
  double rate;                    ///< measured, Hz
  std::vector<std::string> told;  ///< for the user
};

/// Sets the rate, measures it over `duration` (s), and renews the calibration where that needs no hand. Throws Refused.
Trial try_out(const Session& session, double wanted_rate, double duration, std::int64_t (*now_ns)() noexcept);

/// Throws Refused where the device does not know where it is and needs a hand.
void require_calibration(const Interface& hd, std::uint32_t status);

}  // namespace punctura::hd
