// The status of the Inverse Service at an address.
#pragma once

#include <string>

#include "punctura_runtime/backends/status.hpp"

namespace punctura::haply {

BackendStatus status_at(const std::string& url);

}  // namespace punctura::haply
