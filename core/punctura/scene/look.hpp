// How a scene's membranes and the spaces between them are drawn. No force depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace punctura {

/// The drawn kind of a membrane. `plain` is a sheet of glass.
enum class Look : std::uint8_t {
  plain,
  skin,
  fat,
  muscle,
  fascia,
  ligament,
  ligamentum_flavum,
  dura,
  vein_wall,
  artery_wall,
};

/// The content of the space behind a membrane, up to the next membrane. Only `blood` has a meaning beyond the
/// picture: it bounds the lumen (lumen.hpp).
enum class Behind : std::uint8_t { tissue, blood, fat, muscle, epidural_space, cerebrospinal_fluid };

/// The words of scene files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 10> look_words = {
    "plain", "skin", "fat", "muscle", "fascia", "ligament", "ligamentum flavum", "dura", "vein wall", "artery wall"};
inline constexpr std::array<std::string_view, 6> behind_words = {"tissue", "blood",          "fat",
                                                                 "muscle", "epidural space", "cerebrospinal fluid"};

constexpr std::string_view word_of(Look look) noexcept { return look_words[static_cast<std::size_t>(look)]; }
constexpr std::string_view word_of(Behind behind) noexcept { return behind_words[static_cast<std::size_t>(behind)]; }

/// The enumerator with this word; empty if there is none.
template <typename Enum, std::size_t n>
constexpr std::optional<Enum> enum_of(std::string_view word, const std::array<std::string_view, n>& words) noexcept {
  for (std::size_t i = 0; i < n; ++i)
    if (words[i] == word) return static_cast<Enum>(i);
  return std::nullopt;
}

}  // namespace punctura
