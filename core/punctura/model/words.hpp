// The words of scene files for the values of an enumeration.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace punctura {

/// A word for each enumerator, in their order. Specialized beside each enumeration that a scene file can hold.
template <typename Enum>
inline constexpr std::array<std::string_view, 0> words_of{};

template <typename Enum>
constexpr std::string_view word_of(Enum value) noexcept {
  return words_of<Enum>[static_cast<std::size_t>(value)];
}

/// The enumerator with this word; empty if there is none.
template <typename Enum>
constexpr std::optional<Enum> enum_of(std::string_view word) noexcept {
  for (std::size_t i = 0; i < words_of<Enum>.size(); ++i)
    if (words_of<Enum>[i] == word) return static_cast<Enum>(i);
  return std::nullopt;
}

/// For a problem: one of "a", "b".
template <typename Enum>
std::string one_of() {
  std::string text = "one of";
  for (const auto word : words_of<Enum>)
    text += (word == words_of<Enum>.front() ? " \"" : ", \"") + std::string(word) + "\"";
  return text;
}

}  // namespace punctura
