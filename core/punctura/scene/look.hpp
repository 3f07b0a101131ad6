// How a scene's membranes and the spaces between them are drawn. No force depends on it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "punctura/model/words.hpp"

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

template <>
inline constexpr std::array<std::string_view, 10> words_of<Look>{
    "plain", "skin", "fat", "muscle", "fascia", "ligament", "ligamentum flavum", "dura", "vein wall", "artery wall"};
template <>
inline constexpr std::array<std::string_view, 6> words_of<Behind>{"tissue", "blood",          "fat",
                                                                  "muscle", "epidural space", "cerebrospinal fluid"};

}  // namespace punctura
