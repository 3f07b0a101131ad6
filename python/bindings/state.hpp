// State of what goes on from tick to tick: kept as bytes, copied, pickled, tried without a tick.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "bindings.hpp"
#include "punctura/state/archive.hpp"

namespace punctura::bindings {

inline nb::bytes as_bytes(const std::vector<std::byte>& state) { return nb::bytes(state.data(), state.size()); }
inline std::span<const std::byte> as_span(const nb::bytes& state) {
  return {static_cast<const std::byte*>(state.data()), state.size()};
}

/// T has `save()`, `load(bytes)` and `arguments()`, a tuple of what its constructor was given.
template <typename T>
void def_state(nb::class_<T>& cls) {
  const auto name = nb::cast<std::string>(cls.attr("__name__"));
  static const std::string deepcopy = "def __deepcopy__(self, memo: dict[int, typing.Any]) -> " + name;
  cls.def(
         "__copy__", [](const T& self) { return T(self); }, "One that goes on to the same bits.")
      .def(
          "__deepcopy__", [](const T& self, const nb::dict&) { return T(self); }, nb::arg("memo"),
          nb::sig(deepcopy.c_str()))
      .def(
          "__reduce__",
          [](nb::handle self) {
            const auto& object = nb::cast<const T&>(self);
            return nb::make_tuple(nb::module_::import_("punctura.restore").attr("restored"),
                                  nb::make_tuple(self.type(), object.arguments(), as_bytes(object.save())));
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"))
      .def_prop_rw(
          "state", [](const T& self) { return as_bytes(self.save()); },
          [name](T& self, const nb::bytes& state) {
            if (!self.load(as_span(state)))
              throw nb::value_error(("state: these bytes are no state of this " + name +
                                     ": give it those of one with the same parameters, from this version of punctura")
                                        .c_str());
          },
          nb::for_getter(nb::sig("def state(self) -> bytes")),
          nb::for_setter(nb::sig("def state(self, state: bytes, /) -> None")),
          "All that the next tick depends on. Given back, it goes on to the same bits.");
}

}  // namespace punctura::bindings
