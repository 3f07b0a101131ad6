// Constructors, similar words, and warnings for numbers that are off by a factor of 1000.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "bindings.hpp"

namespace punctura::bindings {

/// "; did you mean friction?", or empty if no word is similar.
std::string nearest(const std::string& word, const nb::list& words);

/// The whole number of an argument. Throws TypeError, and ValueError for one below `least` or above `most`.
std::size_t count_from(const nb::object& given, const char* name, std::size_t least, std::size_t most);
/// The argument `threads`: None or 0 is one for each processor.
std::size_t threads_from(const nb::object& given);

/// Defines the constructor of T: `make` with checks of its own. extra: nb::arg for each argument, and a doc.
template <typename T, typename... A, typename... Extra>
void def_init(nb::class_<T>& cls, T (*make)(A...), const Extra&... extra) {
  cls.def("__init__", [make](T* self, A... given) { new (self) T(make(std::forward<A>(given)...)); }, extra...);
}

/// Emits a UserWarning if a number lies outside the usual range of its field in SI units, but inside it in mm, um, N/mm
/// or mN: that unit was most likely meant. path: "membrane.stiffness" or "membrane[0].stiffness".
void warn_unusual(const std::string& path, double value);
/// Sets whether warn_unusual warns in this thread; it does at first. Returns the value before.
bool set_unusual_warnings(bool on);

}  // namespace punctura::bindings
