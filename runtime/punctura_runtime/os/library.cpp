#include <utility>

#include "punctura_runtime/os/os.hpp"

namespace punctura::os {

Library Library::open(const std::vector<std::string>& names) {
  Library library;
  for (const std::string& name : names) {
    std::string error;
    if ((library.handle_ = load_library(name.c_str(), error))) {
      library.path_ = name;
      library.error_.clear();
      return library;
    }
    library.error_ += (library.error_.empty() ? "" : "; ") + error;
  }
  return library;
}

Library::Library(Library&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), path_(std::move(other.path_)), error_(std::move(other.error_)) {}

Library& Library::operator=(Library&& other) noexcept {
  std::swap(handle_, other.handle_);
  std::swap(path_, other.path_);
  std::swap(error_, other.error_);
  return *this;
}

Library::~Library() {
  if (handle_) unload_library(handle_);
}

void* Library::symbol(const char* name) const noexcept { return handle_ ? library_symbol(handle_, name) : nullptr; }

}  // namespace punctura::os
