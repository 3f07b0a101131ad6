// The text of a scene file: its limits, and the digits of its numbers.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace punctura::c {

/// toml++ gives each number as a double, and its place. The digits are needed for the exact conversion to SI units.
class SceneText {
 public:
  explicit SceneText(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);  // a byte-order mark
    for (std::size_t at = 0; at <= text_.size(); at = std::min(text_.find('\n', at), text_.size()) + 1)
      lines_.push_back(at);
  }

  std::string_view all() const noexcept { return text_; }

  /// The number at the place of a node, with a decimal base, without underscores.
  template <typename Node>
  std::string number(const Node& node) const {
    if (const auto* whole = node.as_integer()) return std::to_string(whole->get());  // its base may be 16
    const auto begin = node.source().begin;
    std::string digits;
    auto column = begin.column;
    for (const char c : text_.substr(lines_[begin.line - 1])) {
      if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;  // a column is a character of one byte or more
      if (column > 1) {
        --column;
        continue;
      }
      if (std::string_view("0123456789+-.eE_").find(c) == std::string_view::npos) break;
      if (c != '_') digits += c;
    }
    return digits;
  }

  /// What makes the text too large to read it: toml++ would need a long time for it, or more stack than there is. ""
  /// if nothing does. The limits are those of python/punctura/files/toml.py.
  std::string excess() const {
    constexpr std::size_t most_bytes = 256 * 1024, most_nested = 16, most_dots = 16;
    if (text_.size() > most_bytes)
      return "is larger than " + std::to_string(most_bytes / 1024) + " KiB: no scene needs that";
    std::size_t nested = 0, dots = 0;
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '#') i = std::min(text_.find('\n', i), text_.size()) - 1;
      if (c == '"' || c == '\'') i = end_of_string(i);
      if (c == '[' || c == '{') ++nested, dots = 0;
      if ((c == ']' || c == '}') && nested > 0) --nested;
      if (c == '=' || c == ',' || c == '\n') dots = 0;
      if (c == '.') ++dots;
      if (nested > most_nested) return "lists and tables are nested more than " + std::to_string(most_nested) + " deep";
      if (dots > most_dots) return "a key has more than " + std::to_string(most_dots) + " dots";
    }
    return "";
  }

 private:
  /// The place of the last quote of the string that begins at `at`; the end of the text if there is none.
  std::size_t end_of_string(std::size_t at) const noexcept {
    const char quote = text_[at];
    const std::string_view three = text_.substr(at, 3);
    const bool many = three.size() == 3 && three[1] == quote && three[2] == quote;
    const std::size_t size = many ? 3 : 1;
    for (std::size_t i = at + size; i < text_.size(); ++i) {
      if (text_[i] == '\\' && quote == '"')
        ++i;
      else if (text_.substr(i, size) == three.substr(0, size))
        return i + size - 1 +
               (many ? std::min<std::size_t>(text_.find_first_not_of(quote, i + size) - i - size, 2) : 0);
      else if (text_[i] == '\n' && !many)
        return i;
    }
    return text_.size();
  }

  std::string_view text_;
  std::vector<std::size_t> lines_;  ///< where each line begins
};

}  // namespace punctura::c
