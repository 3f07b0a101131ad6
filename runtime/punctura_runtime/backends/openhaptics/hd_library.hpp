// The HD library, found at run time.
#pragma once

#include <string>
#include <vector>

#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"
#include "punctura_runtime/backends/status.hpp"

namespace punctura::hd {

/// Where the library is looked for when nobody names one, in this order.
std::vector<std::string> usual_places();

struct Loaded {
  const Interface* functions = nullptr;  ///< valid for the rest of the process; nullptr where it could not be had
  BackendStatus::State state = BackendStatus::State::library_not_found;
  std::string detail;  ///< its path, or what is missing and what to do
};

/// named: a path; else that of the environment variable PUNCTURA_HD_LIBRARY; else the usual places. A library that was named is the
/// only one tried. Once loaded it stays: makers' libraries leave threads behind that must not lose their code.
Loaded load(const std::string& named = {});

}  // namespace punctura::hd
