// What the files of the C ABI share: the last error of each thread, the border that no exception crosses, structs that
// begin with struct_size (a caller may know fewer fields than this library), and the scene behind a handle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "punctura.h"
#include "punctura/model/validity.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/scene.hpp"

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

/// The same if none of these pointers is null.
template <typename F>
punctura_status guarded(std::initializer_list<const void*> needed, F&& f) noexcept {
  return guarded([&] {
    const bool missing = std::find(needed.begin(), needed.end(), nullptr) != needed.end();
    return missing ? fail(PUNCTURA_BAD_ARGUMENT, "a pointer is NULL") : f();
  });
}

/// The size of each struct in version 1 of the ABI. A caller's struct is never smaller.
template <typename Struct>
inline constexpr std::size_t first_size = sizeof(Struct);  // add a specialization when a struct grows

inline constexpr std::size_t largest_size = 4096;  ///< of any struct, in any version: more is a slip
template <typename Struct>
bool known_size(std::size_t size) noexcept {
  return size >= first_size<Struct> && size <= largest_size;
}
template <typename Struct>
bool known_size(const Struct* given) noexcept {
  return given && known_size<Struct>(given->struct_size);
}

/// Copies the fields that both sides know into the caller's struct.
template <typename Struct>
void give(Struct* to, const Struct& from) noexcept {
  const std::size_t size = to->struct_size;
  std::memcpy(to, &from, std::min(size, sizeof from));
  to->struct_size = size;
}

/// The fields that the caller knows, and the defaults of the others.
template <typename Struct>
Struct taken(const Struct* from, Struct defaults) noexcept {
  std::memcpy(&defaults, from, std::min(from->struct_size, sizeof defaults));
  return defaults;
}

/// For an _init function: fills the caller's struct of `size` bytes with the defaults.
template <typename Struct>
punctura_status init(Struct* given, std::size_t size, const Struct& defaults) noexcept {
  if (!given || !known_size<Struct>(size)) return PUNCTURA_BAD_ARGUMENT;
  std::memset(given, 0, size);
  std::memcpy(given, &defaults, std::min(size, sizeof defaults));
  given->struct_size = size;
  return PUNCTURA_OK;
}

}  // namespace punctura::c

struct punctura_scene {
  punctura::Scene scene;
};

namespace punctura::c {

/// A new scene from a text of at most `most` bytes. read(text, scene, problems) adds what is wrong. Nothing behind a
/// NUL is read, because a wrong size may lead out of the caller's memory.
template <typename Read>
punctura_status scene_from(const char* text, std::size_t size, std::size_t most, punctura_scene** scene, Read&& read) {
  return guarded({text, scene}, [&] {
    auto made = std::make_unique<punctura_scene>();
    std::vector<Problem> problems;
    const auto refuse = [&](const std::string& why) { problems.push_back({"text", not_given, why}); };
    if (size > most)
      refuse("is larger than " + std::to_string(most / 1024) + " KiB: no scene needs that");
    else if (const void* nul = std::memchr(text, 0, size))
      refuse("ends after " + std::to_string(static_cast<const char*>(nul) - text) +
             " bytes with a NUL, and its size is given as " + std::to_string(size) + ": give the size without the NUL");
    else
      read(std::string_view(text, size), made->scene, problems);
    if (!problems.empty()) return fail(std::move(problems));
    *scene = made.release();
    return ok;
  });
}

}  // namespace punctura::c
