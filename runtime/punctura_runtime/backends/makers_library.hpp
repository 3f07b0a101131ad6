// Makers' libraries: found and loaded when a device is asked for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

/// A function that a library must have, or may have, and the pointer that takes its address.
struct Symbol {
  enum Need { required, optional };

  template <typename Function>
  Symbol(const char* function, Function*& pointer, Need how = required)
      : name(function),
        need(how),
        take([&pointer](void* address) { pointer = reinterpret_cast<Function*>(address); }) {}

  const char* name;
  Need need;
  std::function<void(void*)> take;
};

/// Where a library is looked for, and what messages say of it.
struct LibrarySearch {
  std::string what;                 ///< "The HD library"
  std::string variable;             ///< the environment variable that names its file
  std::vector<std::string> places;  ///< files, or names for the system to find; the first that loads is taken
  std::string also;                 ///< where else it was looked for, for the message: ", ..."
  std::string install, update;      ///< what to do where it is missing, or too old: "Install ..."
};

struct LoadedLibrary {
  BackendStatus::State state = BackendStatus::State::library_not_found;
  std::string detail;  ///< what is wrong and what to do; on a second line, where it was looked for; empty if available
  std::string path;    ///< of the library that was loaded
};

/// Loads a library and takes the functions from it. A file that was named, by `named` or by the variable, is the only
/// one tried. A library stays loaded for the rest of the process: it may have threads of its own.
LoadedLibrary load_makers_library(LibrarySearch search, const std::string& named, const std::vector<Symbol>& symbols);

/// An environment variable; empty if it is not set.
std::string environment(const char* name);

/// "a, b, c"
std::string joined(const std::vector<std::string>& all);

}  // namespace punctura
