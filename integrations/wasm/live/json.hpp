// Writes JSON. Numbers have the fewest digits that give back the same double; a number that is not finite is null.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

namespace punctura::live {

class Json {
 public:
  Json& open(char bracket) {
    comma();
    text_ += bracket;
    first_ = true;
    return *this;
  }
  Json& close(char bracket) {
    text_ += bracket;
    first_ = false;
    return *this;
  }
  Json& key(std::string_view name) {
    value(name);
    text_ += ':';
    first_ = true;
    return *this;
  }
  Json& value(std::string_view words) {
    comma();
    text_ += '"';
    for (const char c : words) {
      char code[8];
      if (c == '"' || c == '\\') text_ += '\\';
      if (static_cast<unsigned char>(c) >= 0x20)
        text_ += c;
      else
        text_.append(code, static_cast<std::size_t>(std::snprintf(code, sizeof code, "\\u%04x", c)));
    }
    text_ += '"';
    return *this;
  }
  Json& value(const char* words) { return value(std::string_view(words)); }
  template <typename Number>
    requires std::is_arithmetic_v<Number>
  Json& value(Number number) {
    comma();
    if constexpr (std::is_same_v<Number, bool>) {
      text_ += number ? "true" : "false";
    } else if (!std::isfinite(static_cast<double>(number))) {
      text_ += "null";
    } else {
      char digits[40];
      text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
    }
    return *this;
  }
  Json& null() {
    comma();
    text_ += "null";
    return *this;
  }
  /// Any range of numbers, as an array.
  template <typename Range>
  Json& all(const Range& numbers) {
    open('[');
    for (const auto& number : numbers) value(number);
    return close(']');
  }
  template <typename Value>
  Json& field(std::string_view name, const Value& of) {
    return key(name).value(of);
  }

  const std::string& text() const noexcept { return text_; }

 private:
  void comma() {
    if (!first_) text_ += ',';
    first_ = false;
  }
  std::string text_;
  bool first_ = true;
};

}  // namespace punctura::live
