// Constructors, similar words, and warnings for numbers that are off by a factor of 1000.
#pragma once

#include <string>
#include <utility>

#include "bindings.hpp"

namespace punctura::bindings {

/// "; did you mean friction?", or empty if no word is similar.
std::string nearest(const std::string& word, const nb::list& words);

/// Defines the constructor of T: `make` with checks of its own. extra: nb::arg for each argument, and a doc.
template <typename T, typename... A, typename... Extra>
void def_init(nb::class_<T>& cls, T (*make)(A...), const Extra&... extra) {
  cls.def("__init__", [make](T* self, A... given) { new (self) T(make(std::forward<A>(given)...)); }, extra...);
}

/// Emits a UserWarning if a number lies outside the usual range of its field in SI units, but inside it in mm, um, N/mm
/// or mN: that unit was most likely meant. path: "membrane.stiffness" or "membrane[0].stiffness".
void warn_unusual(const std::string& path, double value);

}  // namespace punctura::bindings
