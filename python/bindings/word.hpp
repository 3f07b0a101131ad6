// The words of an enumeration as arguments and results: typing.Literal in the signatures.
#pragma once

#include <string>

#include "bindings.hpp"
#include "punctura/model/words.hpp"

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
