// The last error of each thread, and the border that no exception crosses.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "punctura.h"
#include "punctura/model/validity.hpp"

namespace punctura::c {

inline constexpr punctura_status ok = PUNCTURA_OK;

/// Keeps an error without problems. Returns `status`.
punctura_status fail(punctura_status status, std::string text);
/// Keeps the problems of a scene or of limits. Returns PUNCTURA_BAD_SCENE.
punctura_status fail(std::vector<Problem> problems);

/// Calls f(), which returns a status. An exception becomes a status. In WebAssembly there are no exceptions: a lack of
/// memory ends the program.
template <typename F>
punctura_status guarded(F&& f) noexcept {
#if defined(__cpp_exceptions)
  try {
    return f();
  } catch (const std::bad_alloc&) {
    return PUNCTURA_NO_MEMORY;
  } catch (const std::exception& e) {
    try {
      return fail(PUNCTURA_INTERNAL, std::string("a defect of Punctura, please report it: ") + e.what());
    } catch (...) {
      return PUNCTURA_NO_MEMORY;
    }
  } catch (...) {
    return PUNCTURA_INTERNAL;
  }
#else
  return f();
#endif
}

inline punctura_status null_pointer() { return fail(PUNCTURA_BAD_ARGUMENT, "a pointer is NULL"); }

}  // namespace punctura::c
