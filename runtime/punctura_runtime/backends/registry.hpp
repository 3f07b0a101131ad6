// All back-ends.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

/// Adds your own back-end before the others. It must live as long as the program. Throws DeviceError if its name is
/// taken.
void register_backend(const Backend& backend);

/// The status of each back-end, hardware first. Gives no force and leaves no device open.
std::vector<BackendStatus> enumerate_devices();

/// Throws DeviceError with a message that says what to do.
std::shared_ptr<Device> open_device(const std::string& backend, const OpenOptions& options = {});

}  // namespace punctura
