// Force Dimension's library, found when it is asked for.
#pragma once

#include <string>
#include <vector>

#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"
#include "punctura_runtime/backends/status.hpp"

namespace punctura::force_dimension {

/// The library with all its functions, or why there is none.
struct Loaded {
  BackendStatus::State state = BackendStatus::State::library_not_found;
  std::string detail;  ///< of what is wrong: whole sentences
  std::string path;    ///< of the library that was opened
  Api api{};
};

/// path: the library's file; empty takes that of the environment's PUNCTURA_DRD_LIBRARY, and without it looks where the maker's
/// installer and its users put it, for the robotics library first, which holds all of the haptics library. Once opened it stays:
/// a maker's library may have threads of its own.
Loaded load(const std::string& path = {});

/// The files and names that are tried, in this order.
std::vector<std::string> candidates();
/// The folders in which files of such names are looked for, whether they exist or not.
std::vector<std::string> searched_folders();

}  // namespace punctura::force_dimension
