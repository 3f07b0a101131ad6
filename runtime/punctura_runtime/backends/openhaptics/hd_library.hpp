// The HD library, found at run time.
#pragma once

#include <string>
#include <vector>

#include "punctura_runtime/backends/makers_library.hpp"
#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

namespace punctura::hd {

/// Where the library is looked for when nobody names one, in this order.
std::vector<std::string> usual_places();

struct Loaded : LoadedLibrary {
  const Interface* functions =
      nullptr;  ///< valid for the rest of the process, one for each path; nullptr unless `available`
};

/// named: a path; if empty, that of the environment variable PUNCTURA_HD_LIBRARY; else the usual places.
Loaded load(const std::string& named = {});

}  // namespace punctura::hd
