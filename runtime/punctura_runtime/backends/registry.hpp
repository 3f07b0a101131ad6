// All back-ends: what is there, and opening one of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

/// One entry a back-end, in the order in which somebody who does not care which would try them: hardware first. No force is given, and
/// nothing stays open.
std::vector<BackendStatus> enumerate_devices();

/// Throws DeviceError, which says what to do.
std::shared_ptr<Device> open_device(const std::string& backend, const OpenOptions& options = {});

}  // namespace punctura
