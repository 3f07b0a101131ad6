// Makes the parameter classes immutable values in Python.
#pragma once

#include <string>
#include <vector>

#include "bindings.hpp"

namespace punctura::bindings {

inline nb::tuple field_values(nb::handle self, const std::vector<const char*>& fields) {
  nb::list list;
  for (const char* field : fields) list.append(self.attr(field));
  return nb::tuple(list);
}

/// Defines repr, equality and hash by the fields, and `replace`, which makes a changed, checked copy. Fields are
/// read-only, because setting one on a temporary copy (scene.membranes[0].membrane.friction = ...) would have no
/// effect.
template <typename T>
void def_value(nb::class_<T>& cls, std::vector<const char*> fields) {
  const auto name = nb::cast<std::string>(cls.attr("__name__"));
  static const std::string replace_signature = "def replace(self, **changes: typing.Any) -> " + name;
  cls.def("__repr__", [fields, name](nb::handle self) {
    std::string text = name + "(";
    for (const char* field : fields) {
      if (text.back() != '(') text += ", ";
      text += std::string(field) + "=" + nb::cast<std::string>(nb::repr(self.attr(field)));
    }
    return text + ")";
  });
  cls.def(
      "__eq__",
      [fields](nb::handle self, nb::handle other) {
        return self.type().is(other.type()) && field_values(self, fields).equal(field_values(other, fields));
      },
      nb::sig("def __eq__(self, other: object, /) -> bool"));
  cls.def("__hash__", [fields](nb::handle self) { return nb::hash(field_values(self, fields)); });
  cls.def(
      "__reduce__", [fields](nb::handle self) { return nb::make_tuple(self.type(), field_values(self, fields)); },
      nb::sig("def __reduce__(self) -> tuple[type, tuple[typing.Any, ...]]"));
  cls.def(
      "replace",
      [fields](nb::handle self, const nb::kwargs& changes) {
        nb::dict arguments;
        for (const char* field : fields) arguments[field] = self.attr(field);
        arguments.update(changes);
        return self.type()(**arguments);
      },
      nb::sig(replace_signature.c_str()), "A checked copy with some fields changed.");
}

inline nb::tuple as_tuple(const Triple& v) { return nb::make_tuple(v[0], v[1], v[2]); }

}  // namespace punctura::bindings
