// Messages for the HD library's error codes.
#pragma once

#include <string>

#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

namespace punctura::hd {

/// The device limits its own force and continues: counted, not a reason to stop.
constexpr bool is_warning(std::uint32_t code) noexcept { return code >= warm_motors && code <= exceeded_max_velocity; }

/// "COMM_ERROR (0x302, internal -28): the link to the device broke ..."
std::string describe(const ErrorInfo& error);

/// How the user calibrates such a device.
std::string how_to_calibrate(std::uint32_t styles);

}  // namespace punctura::hd
