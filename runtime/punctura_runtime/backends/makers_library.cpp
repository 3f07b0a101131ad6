#include "punctura_runtime/backends/makers_library.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "punctura_runtime/os/os.hpp"

namespace punctura {

namespace {

/// Whether the file exists and yet did not load. Where the system looked for it by its name, the error is then about
/// another file.
bool exists(const std::string& place, const std::string& error) {
  std::error_code ignored;
  if (place.find_first_of("/\\") != std::string::npos) return std::filesystem::exists(place, ignored);
  return error.find("cannot open shared object") != std::string::npos && !error.starts_with(place + ":");
}

}  // namespace

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::string joined(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& one : all) text += (text.empty() ? "" : ", ") + one;
  return text;
}

LoadedLibrary load_makers_library(LibrarySearch search, const std::string& named, const std::vector<Symbol>& symbols) {
  const std::string only = named.empty() ? environment(search.variable.c_str()) : named;
  if (!only.empty()) {
    search.places = {only};
    search.also.clear();
  }
  const std::string or_name = ", or name the library in " + search.variable + ".";

  std::string broken;
  for (const std::string& place : search.places) {
    std::string error;
    void* const library = os::load_library(place.c_str(), error);
    if (!library) {
      if (!only.empty() || exists(place, error)) broken += " " + place + " does not load: " + error + ".";
      continue;
    }
    std::vector<std::string> missing;
    for (const Symbol& symbol : symbols) {
      void* const address = os::library_symbol(library, symbol.name);
      symbol.take(address);
      if (!address && symbol.need == Symbol::required) missing.emplace_back(symbol.name);
    }
    if (missing.empty()) return {BackendStatus::State::available, "", place};
    return {BackendStatus::State::symbol_missing,
            place + " lacks " + joined(missing) + ": it is too old, or another library. " + search.update + or_name,
            place};
  }
  return {BackendStatus::State::library_not_found,
          search.what + " was not found." + broken + " " + search.install + or_name +
              "\nLooked for: " + joined(search.places) + search.also + ".",
          ""};
}

}  // namespace punctura
