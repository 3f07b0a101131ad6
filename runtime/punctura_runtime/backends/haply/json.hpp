// A bounded reader of JSON (RFC 8259) that takes no memory: it walks over a text once, and its caller picks what it knows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace punctura::haply {

/// Stands at a value of a text. Each of the calls takes one value, whatever its kind: a value of another kind than was asked for
/// is passed over and gives nothing, so that every field is optional. What is not JSON makes all of it fail: see whole().
///
///     JsonReader json(text);
///     json.object([&](std::string_view key) { key == "x" ? take(json.number()) : json.skip(); });
///
/// Keys and strings are given as they stand in the text, with escapes not resolved: one with an escape equals no name of ours.
class JsonReader {
 public:
  static constexpr int deepest = 32;  ///< arrays and objects within one another

  explicit JsonReader(std::string_view text) noexcept : text_(text) {}

  /// Calls `member(key)` for each member, which must take the value by one call. False when the value is no object.
  template <typename Member>
  bool object(Member&& member) noexcept {
    if (!enter('{')) return false;
    if (leave('}')) return true;
    do {
      std::string_view key;
      blanks();
      if (!quoted(key) || !expect(':')) return fail();
      member(key);
    } while (more('}'));
    return !failed_;
  }

  /// Calls `element()` for each element, which must take the value by one call. False when the value is no array.
  template <typename Element>
  bool array(Element&& element) noexcept {
    if (!enter('[')) return false;
    if (leave(']')) return true;
    do {
      element();
    } while (more(']'));
    return !failed_;
  }

  std::optional<double>
  number() noexcept;  ///< correctly rounded, whatever the locale; nothing where it is no finite double
  std::optional<bool> boolean() noexcept;
  std::optional<std::string_view> string() noexcept;
  void skip() noexcept;

  /// Whether all that was read was JSON, and nothing but blanks follows it.
  bool whole() noexcept;

 private:
  bool fail() noexcept {
    failed_ = true;
    return false;
  }
  char peek() const noexcept { return at_ < text_.size() ? text_[at_] : '\0'; }
  void blanks() noexcept;
  bool expect(char c) noexcept;       ///< takes c, with blanks before it
  bool enter(char bracket) noexcept;  ///< takes the value's bracket; passes over a value of another kind
  bool leave(char bracket) noexcept;  ///< takes the closing bracket if it comes next
  bool more(char bracket) noexcept;   ///< a comma: true. The closing bracket: false
  bool quoted(std::string_view& raw) noexcept;
  bool numeral(std::string_view& raw) noexcept;
  bool literal(std::string_view word) noexcept;

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace punctura::haply
