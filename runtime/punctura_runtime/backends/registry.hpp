// All back-ends: what is there, and opening one of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

/// Adds a back-end of your own to those of enumerate_devices() and open_device(), before them. It must live as long as the program. Throws
/// DeviceError where one of that name is there.
void register_backend(const Backend& backend);

/// One entry a back-end, in the order in which somebody who does not care which would try them: hardware first. No force is given, and
/// nothing stays open.
std::vector<BackendStatus> enumerate_devices();

/// Throws DeviceError, which says what to do.
std::shared_ptr<Device> open_device(const std::string& backend, const OpenOptions& options = {});

}  // namespace punctura
