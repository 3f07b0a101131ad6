// What the registry says of an Inverse Service at some address.
#pragma once

#include <string>

#include "punctura_runtime/backends/status.hpp"

namespace punctura::haply {

BackendStatus status_at(const std::string& url);

}  // namespace punctura::haply
