// Python types of arguments and results that C++ takes and gives as plain objects.
#pragma once

#include <nanobind/nanobind.h>

#include <algorithm>
#include <cstddef>

namespace punctura::bindings {

template <std::size_t n>
struct TypeText {
  char text[n];
  consteval TypeText(const char (&given)[n]) { std::copy_n(given, n, text); }
};
template <TypeText type>
struct Named {};
/// An object with this type in the signature. nanobind does not check it.
template <TypeText type>
using Object = nanobind::typed<nanobind::object, Named<type>>;

using ArrayLike = Object<"numpy.typing.ArrayLike">;
using Floats = Object<"numpy.typing.NDArray[numpy.float64]">;
using Columns = Object<"dict[str, numpy.typing.NDArray[typing.Any]]">;
using TicksObject = Object<"Ticks">;
using ProgressArgument = Object<"Progress">;

}  // namespace punctura::bindings

template <punctura::bindings::TypeText type>
struct nanobind::detail::type_caster<punctura::bindings::Named<type>> {
  static constexpr auto Name = const_name(type.text);
};
