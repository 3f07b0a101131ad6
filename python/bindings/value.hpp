// Words and other immutable values in Python.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "punctura/model/field.hpp"

namespace punctura::bindings {

/// A word for a value of an enumeration. As an argument it is any text until at() has looked it up.
template <typename Enum>
struct Word {
  std::string text;

  Word() = default;
  Word(Enum value) : text(word_of(value)) {}

  /// The value. Throws ConfigurationError with all words.
  Enum at(const std::string& path) const {
    if (const auto found = enum_of<Enum>(text)) return *found;
    std::string reason = "must be " + one_of<Enum>();
    if constexpr (words_of<Enum>.size() == 2)
      reason = "must be \"" + std::string(words_of<Enum>[0]) + "\" or \"" + std::string(words_of<Enum>[1]) + "\"";
    raise_word(path, text, reason.c_str());
  }
};

/// "typing.Literal['exact', 'paper']" as a name for signatures.
template <typename Enum>
constexpr auto literal() {
  constexpr auto& words = words_of<Enum>;
  constexpr std::size_t size = [] {
    std::size_t n = 0;
    for (const auto word : words) n += word.size() + 4;  // the quotes, the comma and the space
    return n - 2;
  }();
  char text[size + 1]{};
  std::size_t at = 0;
  for (const auto word : words) {
    if (at > 0) text[at++] = ',', text[at++] = ' ';
    text[at++] = '\'';
    for (const char c : word) text[at++] = c;
    text[at++] = '\'';
  }
  using nb::detail::const_name;
  return const_name("typing.Literal[") + nb::detail::descr<size>(text) + const_name("]");
}

}  // namespace punctura::bindings

template <typename Enum>
struct nb::detail::type_caster<punctura::bindings::Word<Enum>> {
  NB_TYPE_CASTER(punctura::bindings::Word<Enum>, punctura::bindings::literal<Enum>())

  bool from_python(handle from, std::uint32_t flags, cleanup_list* cleanup) noexcept {
    make_caster<std::string> text;
    if (!text.from_python(from, flags, cleanup)) return false;
    value.text = std::move(text.value);
    return true;
  }
  static handle from_cpp(const punctura::bindings::Word<Enum>& word, rv_policy, cleanup_list*) noexcept {
    return PyUnicode_FromStringAndSize(word.text.data(), static_cast<Py_ssize_t>(word.text.size()));
  }
};

namespace punctura::bindings {

inline nb::tuple field_values(nb::handle self, const std::vector<const char*>& fields) {
  nb::list list;
  for (const char* field : fields) list.append(self.attr(field));
  return nb::tuple(list);
}

/// Defines repr by the fields: "Needle(diameter=0.001, tip_angle=0.28)".
template <typename T>
void def_repr(nb::class_<T>& cls, const std::vector<const char*>& fields) {
  cls.def("__repr__", [fields](nb::handle self) {
    std::string text;
    for (const char* field : fields)
      text += (text.empty() ? "" : ", ") + std::string(field) + "=" + nb::repr(self.attr(field)).c_str();
    return nb::cast<std::string>(self.type().attr("__name__")) + "(" + text + ")";
  });
}

/// Defines equality and pickling by the fields, which are the arguments of the constructor.
template <typename T, typename... Options>
void def_fields(nb::class_<T, Options...>& cls, const std::vector<const char*>& fields) {
  cls.def(
      "__eq__",
      [fields](nb::handle self, nb::handle other) {
        return self.type().is(other.type()) && field_values(self, fields).equal(field_values(other, fields));
      },
      nb::sig("def __eq__(self, other: object, /) -> bool"));
  cls.def(
      "__reduce__", [fields](nb::handle self) { return nb::make_tuple(self.type(), field_values(self, fields)); },
      nb::sig("def __reduce__(self) -> tuple[type, tuple[typing.Any, ...]]"));
}

/// Defines repr, equality and hash by the fields, and `replace`, which makes a changed, checked copy. Fields are
/// read-only, because setting one on a temporary copy (scene.membranes[0].membrane.friction = ...) would have no
/// effect.
template <typename T>
void def_value(nb::class_<T>& cls, const std::vector<const char*>& fields) {
  def_repr(cls, fields);
  def_fields(cls, fields);
  cls.def("__hash__", [fields](nb::handle self) { return nb::hash(field_values(self, fields)); });
  const auto name = nb::cast<std::string>(cls.attr("__name__"));
  cls.def(
      "replace",
      [fields](nb::handle self, const nb::kwargs& changes) {
        nb::dict arguments;
        for (const char* field : fields) arguments[field] = self.attr(field);
        arguments.update(changes);
        return self.type()(**arguments);
      },
      nb::sig(("def replace(self, **changes: typing.Any) -> " + name).c_str()),
      "A checked copy with some fields changed.");
}

template <typename Entry>
nb::typed<nb::tuple, Entry, nb::ellipsis> shown_tuple(const std::vector<Entry>& entries) {
  return nb::tuple(nb::cast(entries));
}

/// Defines an enumeration with the words of the core. help: of each, in their order.
template <typename Enum>
void def_words(nb::module_& m, const char* name, const char* what,
               const std::array<const char*, words_of<Enum>.size()>& help = {}) {
  nb::enum_<Enum> made(m, name, nb::is_arithmetic(), what);
  for (std::size_t i = 0; i < help.size(); ++i)
    made.value(words_of<Enum>[i].data(), static_cast<Enum>(i), help[i]);  // each word is a literal, which ends with 0
}

}  // namespace punctura::bindings
