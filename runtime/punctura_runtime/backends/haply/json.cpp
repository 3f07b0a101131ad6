#include "punctura_runtime/backends/haply/json.hpp"

#include "punctura/model/decimal.hpp"

namespace punctura::haply {

namespace {

bool digit(char c) noexcept { return '0' <= c && c <= '9'; }
bool hex(char c) noexcept { return digit(c) || ('a' <= c && c <= 'f') || ('A' <= c && c <= 'F'); }

}  // namespace

void JsonReader::blanks() noexcept {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t'))
    ++at_;
}

bool JsonReader::expect(char c) noexcept {
  blanks();
  if (peek() != c) return false;
  ++at_;
  return true;
}

bool JsonReader::enter(char bracket) noexcept {
  if (failed_) return false;
  blanks();
  if (peek() != bracket) {
    skip();
    return false;
  }
  if (depth_ == deepest) return fail();
  ++depth_;
  ++at_;
  return true;
}

bool JsonReader::leave(char bracket) noexcept {
  if (!expect(bracket)) return false;
  --depth_;
  return true;
}

bool JsonReader::more(char bracket) noexcept {
  if (failed_) return false;
  if (expect(',')) return true;
  return leave(bracket) ? false : fail();
}

bool JsonReader::quoted(std::string_view& raw) noexcept {
  if (peek() != '"') return false;
  const std::size_t begin = ++at_;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '"') {
      raw = text_.substr(begin, at_ - begin);
      ++at_;
      return true;
    }
    if (static_cast<unsigned char>(c) < 0x20) return false;
    if (c != '\\') continue;
    ++at_;
    if (peek() == 'u') {
      for (int i = 0; i < 4; ++i)
        if (++at_ >= text_.size() || !hex(text_[at_])) return false;
    } else if (peek() == '\0' || std::string_view("\"\\/bfnrt").find(peek()) == std::string_view::npos) {
      return false;
    }
  }
  return false;
}

bool JsonReader::numeral(std::string_view& raw) noexcept {
  const std::size_t begin = at_;
  const auto digits = [&] {
    const std::size_t first = at_;
    while (digit(peek())) ++at_;
    return at_ > first;
  };
  if (peek() == '-') ++at_;
  if (peek() == '0')
    ++at_;  // only a point or an exponent may follow
  else if (!digits())
    return false;
  if (peek() == '.') {
    ++at_;
    if (!digits()) return false;
  }
  if (peek() == 'e' || peek() == 'E') {
    ++at_;
    if (peek() == '+' || peek() == '-') ++at_;
    if (!digits()) return false;
  }
  raw = text_.substr(begin, at_ - begin);
  return true;
}

bool JsonReader::literal(std::string_view word) noexcept {
  if (!text_.substr(at_).starts_with(word)) return false;
  at_ += word.size();
  return true;
}

std::optional<double> JsonReader::number() noexcept {
  blanks();
  std::string_view raw;
  if (failed_ || (peek() != '-' && !digit(peek()))) return skip(), std::nullopt;
  if (!numeral(raw)) return fail(), std::nullopt;
  return read_decimal(raw);
}

std::optional<bool> JsonReader::boolean() noexcept {
  blanks();
  if (!failed_ && literal("true")) return true;
  if (!failed_ && literal("false")) return false;
  return skip(), std::nullopt;
}

std::optional<std::string_view> JsonReader::string() noexcept {
  blanks();
  std::string_view raw;
  if (failed_ || peek() != '"') return skip(), std::nullopt;
  if (!quoted(raw)) return fail(), std::nullopt;
  return raw;
}

void JsonReader::skip() noexcept {
  if (failed_) return;
  blanks();
  std::string_view raw;
  bool taken = false;
  switch (peek()) {
    case '{': taken = object([this](std::string_view) { skip(); }); break;
    case '[': taken = array([this] { skip(); }); break;
    case '"': taken = quoted(raw); break;
    case 't': taken = literal("true"); break;
    case 'f': taken = literal("false"); break;
    case 'n': taken = literal("null"); break;
    default: taken = numeral(raw);
  }
  if (!taken) fail();
}

bool JsonReader::whole() noexcept {
  blanks();
  return !failed_ && at_ == text_.size();
}

}  // namespace punctura::haply
