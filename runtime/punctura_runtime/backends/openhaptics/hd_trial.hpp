// Runs the scheduler for a short time without force: measures its rate and checks the calibration.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "punctura_runtime/backends/openhaptics/hd_session.hpp"

namespace punctura::hd {

struct Trial {
  unsigned long set;                    ///< Hz, as accepted by the library
  double rate;                          ///< measured, Hz
  std::vector<std::string> statements;  ///< for the user
};

/// Sets the rate, measures it over `duration` (s), and renews the calibration if that needs no user. Throws Refusal,
/// also if the measurement takes longer by more than `patience` (s).
Trial try_out(const Session& session, double wanted_rate, double duration, double patience,
              std::int64_t (*now_ns)() noexcept);

/// Throws Refusal if the user must calibrate the device.
void require_calibration(const Interface& hd, std::uint32_t status);

}  // namespace punctura::hd
