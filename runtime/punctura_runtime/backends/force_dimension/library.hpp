// Force Dimension's library, found at run time.
#pragma once

#include <string>
#include <vector>

#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"
#include "punctura_runtime/backends/makers_library.hpp"

namespace punctura::force_dimension {

struct Loaded : LoadedLibrary {
  Api api{};  ///< all functions, if it is `available`
};

/// named: a path; if empty, that of the environment variable PUNCTURA_DRD_LIBRARY; else where the maker's installer and
/// its users put it. The robotics library comes first: it holds all of the haptics library.
Loaded load(const std::string& named = {});

/// The files and names that are tried, in this order.
std::vector<std::string> candidates();
/// The folders in which files of such names are looked for, whether they exist or not.
std::vector<std::string> searched_folders();

}  // namespace punctura::force_dimension
