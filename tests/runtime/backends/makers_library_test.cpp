#include "punctura_runtime/backends/makers_library.hpp"

#include <doctest/doctest.h>

#include "runtime/support/environment.hpp"

using namespace punctura;
using BackendState = BackendStatus::State;

namespace {

const char* const fake_library = FAKE_HD;

LibrarySearch search(std::vector<std::string> places) {
  return {"The library", "PUNCTURA_TEST_LIBRARY", std::move(places), "", "Install it", "Install a newer one"};
}

bool detail_says(const LoadedLibrary& loaded, const char* words) {
  return loaded.detail.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("the first library that loads is taken, with its functions; an optional one may be missing") {
  void (*present)() = nullptr;
  void (*absent)() = present;
  const auto loaded = load_makers_library(search({"/nowhere/a.so", fake_library}), "",
                                          {{"hdBeginFrame", present}, {"hdNothing", absent, Symbol::optional}});
  CHECK(loaded.state == BackendState::available);
  CHECK(loaded.path == fake_library);
  CHECK(loaded.detail == "");
  CHECK(bool(present));
  CHECK_FALSE(bool(absent));
}

TEST_CASE("a library that lacks functions is refused, with their names and what to do") {
  void (*absent)() = nullptr;
  const auto loaded = load_makers_library(search({fake_library}), "", {{"hdNothing", absent}, {"hdNeither", absent}});
  CHECK(loaded.state == BackendState::symbol_missing);
  CHECK(detail_says(loaded,
                    "lacks hdNothing, hdNeither: it is too old, or another library. Install a newer one, or name the "
                    "library in PUNCTURA_TEST_LIBRARY."));
}

TEST_CASE("without a library, the message says what to do, and lists all searched places on a line of their own") {
  const auto loaded = load_makers_library(search({"/nowhere/a.so", "/nowhere/b.so"}), "", {});
  CHECK(loaded.state == BackendState::library_not_found);
  CHECK(loaded.detail ==
        "The library was not found. Install it, or name the library in PUNCTURA_TEST_LIBRARY.\n"
        "Looked for: /nowhere/a.so, /nowhere/b.so.");
}

TEST_CASE("only a named library is tried: the caller's name, then the variable's") {
  CHECK(load_makers_library(search({fake_library}), "/nowhere/c.so", {}).state == BackendState::library_not_found);
  const test::Environment named("PUNCTURA_TEST_LIBRARY", "/nowhere/d.so");
  const auto missing = load_makers_library(search({fake_library}), "", {});
  CHECK(missing.state == BackendState::library_not_found);
  CHECK(detail_says(missing, "/nowhere/d.so does not load: "));
  CHECK(load_makers_library(search({}), fake_library, {}).state == BackendState::available);
}
