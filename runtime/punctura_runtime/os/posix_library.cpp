// Shared libraries on Linux and macOS.
#include <dlfcn.h>

#include "punctura_runtime/os/os.hpp"

namespace punctura::os {

void* load_library(const char* name, std::string& error) {
  // Global, since some makers' libraries use symbols of others that they do not name.
  void* handle = dlopen(name, RTLD_LAZY | RTLD_GLOBAL);
  if (!handle) error = dlerror();
  return handle;
}

void* library_symbol(void* library, const char* name) noexcept { return dlsym(library, name); }

}  // namespace punctura::os
