// The names in a scene. Screens, terminals, logs and XML files show them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/model/validity.hpp"

namespace punctura {

/// Whether a text is UTF-8 without control characters other than a tab: what TOML permits between quotes, without the
/// second set of control characters (U+0080 to U+009F), which terminals obey, too.
inline bool is_plain_text(std::string_view text) noexcept {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(i + k < text.size() ? text[i + k] : 0); };
    const unsigned first = byte(0);
    const std::size_t size = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    char32_t code = size == 1 ? first : first & (0x7fu >> size);
    for (std::size_t k = 1; k < size; ++k) {
      if ((byte(k) & 0xc0) != 0x80) return false;
      code = (code << 6) | (byte(k) & 0x3fu);
    }
    constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool control = (code < 0x20 && code != '\t') || (code >= 0x7f && code < 0xa0);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    if ((first >= 0x80 && first < 0xc2) || first > 0xf4 || code < least[size] || code > 0x10ffff || control ||
        surrogate)
      return false;
    i += size;
  }
  return true;
}

/// Characters. Longer names fill a page, a legend or a table.
inline constexpr std::size_t longest_name = 200;

/// Adds a problem if a name is no plain text, or too long. Returns true if it is good.
inline bool check_name(std::string_view name, const std::string& path, std::vector<Problem>& problems) {
  std::string reason;
  if (!is_plain_text(name))
    reason = "must be text in UTF-8 without control characters (a new line, an escape)";
  else if (const auto size = static_cast<std::size_t>(std::count_if(
               name.begin(), name.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
           size > longest_name)
    reason = "must have at most " + std::to_string(longest_name) + " characters; it has " + std::to_string(size);
  if (reason.empty()) return true;
  problems.push_back({path, not_given, reason});
  return false;
}

}  // namespace punctura
