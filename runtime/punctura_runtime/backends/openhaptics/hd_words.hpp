// What the HD library's codes mean, and what to do, in words.
#pragma once

#include <string>

#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

namespace punctura::hd {

/// The device limits its own force and goes on: counted, and no reason to stop.
constexpr bool is_warning(std::uint32_t code) noexcept { return code >= warm_motors && code <= exceeded_max_velocity; }

/// "COMM_ERROR (0x302, internal -28): the link to the device broke ..."
std::string describe(const ErrorInfo& error);

/// What the user has to do before such a device knows where it is.
std::string how_to_calibrate(std::uint32_t styles);

}  // namespace punctura::hd
