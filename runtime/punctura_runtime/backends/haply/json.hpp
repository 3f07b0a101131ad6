// A JSON reader (RFC 8259) that does not allocate. It walks over a text once; its caller picks the values that it
// wants.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace punctura::haply {

/// Each call reads one value. A value of another kind than was asked for is skipped and gives nothing, so every field
/// is optional. After a text that is not JSON, all calls fail: see whole().
///
///     JsonReader json(text);
///     json.object([&](std::string_view key) { if (key == "x") take(json.number()); });
///
/// Keys and strings are given as they stand in the text, with their escapes: one with an escape equals none of our
/// names.
class JsonReader {
 public:
  static constexpr int deepest = 32;  ///< levels of arrays and objects

  explicit JsonReader(std::string_view text) noexcept : text_(text) {}

  /// Calls `member(key)` for each member. It reads the value by one call, or leaves it. False if the value is not an
  /// object.
  template <typename Member>
  bool object(Member&& member) noexcept {
    if (!enter('{')) return false;
    if (leave('}')) return true;
    do {
      std::string_view key;
      blanks();
      if (!quoted(key) || !expect(':')) return fail();
      const std::size_t value = at_;
      member(key);
      if (at_ == value) skip();
    } while (more('}'));
    return !failed_;
  }

  /// Calls `element()` for each element. It reads the value by one call, or leaves it. False if the value is not an
  /// array.
  template <typename Element>
  bool array(Element&& element) noexcept {
    if (!enter('[')) return false;
    if (leave(']')) return true;
    do {
      const std::size_t value = at_;
      element();
      if (at_ == value) skip();
    } while (more(']'));
    return !failed_;
  }

  std::optional<double> number() noexcept;  ///< nothing if it is outside the range of a double
  std::optional<bool> boolean() noexcept;
  std::optional<std::string_view> string() noexcept;
  void skip() noexcept;

  /// Whether all that was read is JSON, and only blanks follow.
  bool whole() noexcept;

 private:
  bool fail() noexcept {
    failed_ = true;
    return false;
  }
  char peek() const noexcept { return at_ < text_.size() ? text_[at_] : '\0'; }
  void blanks() noexcept;
  bool expect(char c) noexcept;       ///< reads c, and blanks before it
  bool enter(char bracket) noexcept;  ///< reads an opening bracket; skips a value of another kind
  bool leave(char bracket) noexcept;  ///< reads a closing bracket if it is next
  bool more(char bracket) noexcept;   ///< true after a comma, false after the closing bracket
  bool quoted(std::string_view& raw) noexcept;
  bool numeral(std::string_view& raw) noexcept;
  bool literal(std::string_view word) noexcept;

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace punctura::haply
