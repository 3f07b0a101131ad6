#include "punctura_runtime/backends/haply/websocket.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "punctura_runtime/os/os.hpp"

namespace punctura::haply {

std::string upgrade_request(std::string_view authority) {
  return "GET / HTTP/1.1\r\nHost: " + std::string(authority) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: " + std::string(upgrade_key) +
         "\r\nSec-WebSocket-Version: 13\r\n\r\n";
}

namespace {

std::string lower(std::string_view text) {
  std::string all(text);
  std::ranges::transform(all, all.begin(), [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return all;
}

/// The value of a header field without the blanks around it; empty where there is none.
std::string_view field(std::string_view answer, std::string_view name) {
  for (std::size_t at = answer.find("\r\n"); at != std::string_view::npos; at = answer.find("\r\n", at + 2)) {
    const std::string_view line = answer.substr(at + 2, answer.find("\r\n", at + 2) - (at + 2));
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || lower(line.substr(0, colon)) != name) continue;
    const std::size_t first = line.find_first_not_of(" \t", colon + 1), last = line.find_last_not_of(" \t");
    return first == std::string_view::npos ? "" : line.substr(first, last + 1 - first);
  }
  return {};
}

}  // namespace

std::string upgrade_refusal(std::string_view answer) {
  const std::string_view status = answer.substr(0, answer.find("\r\n"));
  if (!status.starts_with("HTTP/1.1 101")) {
    std::string first_line(status.substr(0, 60));
    std::ranges::replace_if(first_line, [](char c) { return c < ' ' || c > '~'; }, '?');
    return "it answered \"" + first_line + "\" to the request for a WebSocket";
  }
  if (lower(field(answer, "upgrade")) != "websocket" ||
      lower(field(answer, "connection")).find("upgrade") == std::string::npos)
    return "it refused to become a WebSocket";
  if (field(answer, "sec-websocket-accept") != upgrade_accept) return "its Sec-WebSocket-Accept is wrong";
  if (!field(answer, "sec-websocket-extensions").empty()) return "it uses an extension that was not offered";
  return {};
}

namespace {

constexpr std::size_t largest_head = 8192;

std::string words(os::Io how) {
  switch (how) {
    case os::Io::timeout: return "it does not answer";
    case os::Io::closed: return "it closed the connection";
    default: return "the connection failed";
  }
}

}  // namespace

const char* describe(Received how) noexcept {
  switch (how) {
    case Received::message: return "a message came";
    case Received::timeout: return "no answer came in time";
    case Received::closed: return "the service closed the connection";
    case Received::broken: return "what came is not the WebSocket protocol";
    case Received::too_big: return "a message was too long";
    case Received::failed: return "the connection failed";
  }
  return "unknown";
}

std::string WebSocket::open(const Url& url, std::int64_t deadline) {
  std::string error;
  socket_ = os::Socket();
  reader_ = FrameReader(largest_message);
  reason_size_ = 0;
  os::Socket socket = os::Socket::connect(url.host, url.port, deadline, error);
  if (!socket) return error;

  mask_.seed(std::random_device{}());
  const std::string request = upgrade_request(url.authority());
  if (const os::Io how = socket.send(request.data(), request.size(), deadline); how != os::Io::done) return words(how);

  std::string answer;
  std::size_t end = std::string::npos;
  while (end == std::string::npos) {
    std::array<char, 1024> piece;
    std::size_t n = 0;
    const os::Io how = socket.receive(piece.data(), piece.size(), n, deadline);
    if (how != os::Io::done) return words(how);
    answer.append(piece.data(), n);
    end = answer.find("\r\n\r\n");
    if (answer.size() > largest_head) return "its answer does not end";
  }
  error = upgrade_refusal(std::string_view(answer).substr(0, end));
  if (!error.empty()) return error;

  // The piece may have the first frames, too.
  const std::string_view rest = std::string_view(answer).substr(end + 4);
  std::ranges::copy(rest, reader_.space().begin());
  reader_.filled(rest.size());
  socket_ = std::move(socket);
  return {};
}

bool WebSocket::send(Opcode opcode, std::string_view payload, std::int64_t deadline) noexcept {
  if (!socket_ || payload.size() > largest_command) return false;
  const std::size_t n = write_frame(opcode, payload, static_cast<std::uint32_t>(mask_()), out_);
  return socket_.send(out_.data(), n, deadline) == os::Io::done;
}

Received WebSocket::receive(std::string_view& text, std::int64_t deadline) noexcept {
  bool dripping = false;
  for (;;) {
    std::string_view payload;
    switch (reader_.next(payload)) {
      case Event::text: text = payload; return Received::message;
      case Event::binary: return Received::broken;  // the service sends text only
      case Event::ping:
        if (!send(Opcode::pong, payload, deadline)) return Received::failed;
        if (os::now_ns() >= deadline) return Received::timeout;  // also if pings come without end
        continue;
      case Event::pong: continue;
      case Event::close: keep_reason(payload); return Received::closed;
      case Event::broken: return Received::broken;
      case Event::too_big: return Received::too_big;
      case Event::more: break;
    }
    // Checked before each piece: a message that arrives byte by byte must not delay a tick beyond the deadline.
    if (dripping && os::now_ns() >= deadline) return Received::timeout;
    dripping = true;
    const auto space = reader_.space();
    std::size_t n = 0;
    switch (socket_.receive(space.data(), space.size(), n, deadline)) {
      case os::Io::done: reader_.filled(n); break;
      case os::Io::timeout: return Received::timeout;
      case os::Io::closed: return Received::closed;
      case os::Io::failed: return Received::failed;
    }
  }
}

void WebSocket::keep_reason(std::string_view payload) noexcept {
  if (payload.size() <= 2) return;  // a code of two bytes, then a text
  reason_size_ = payload.size() - 2;
  std::ranges::transform(payload.substr(2), reason_.begin(), [](char c) { return ' ' <= c && c <= '~' ? c : '?'; });
}

void WebSocket::close() noexcept {
  if (!socket_) return;
  send(Opcode::close, std::string_view("\x03\xe8", 2), os::now_ns());  // 1000: normal closure
  socket_.close();
}

std::string http_get(const Url& url, std::string_view path, std::int64_t deadline, std::string& error) {
  os::Socket socket = os::Socket::connect(url.host, url.port, deadline, error);
  if (!socket) return {};
  const std::string request =
      "GET " + std::string(path) + " HTTP/1.1\r\nHost: " + url.authority() + "\r\nConnection: close\r\n\r\n";
  os::Io how = socket.send(request.data(), request.size(), deadline);
  std::string answer;
  while (how == os::Io::done && answer.size() < 16384) {
    std::array<char, 1024> piece;
    std::size_t n = 0;
    how = socket.receive(piece.data(), piece.size(), n, deadline);
    answer.append(piece.data(), n);
  }
  const std::size_t end = answer.find("\r\n\r\n");
  if (!answer.starts_with("HTTP/1.1 200") || end == std::string::npos) {
    error = answer.empty() ? words(how) : "it answered " + answer.substr(0, answer.find("\r\n")).substr(0, 60);
    return {};
  }
  return answer.substr(end + 4);
}

std::optional<Url> parse_url(std::string_view text) {
  constexpr std::string_view scheme = "ws://";
  if (!text.starts_with(scheme)) return {};
  text.remove_prefix(scheme.size());
  if (text.ends_with('/')) text.remove_suffix(1);

  Url url;
  std::size_t end = text.find(':');
  if (text.starts_with('[')) {  // an IPv6 address has colons of its own
    const std::size_t bracket = text.find(']');
    if (bracket == std::string_view::npos) return {};
    url.host = text.substr(1, bracket - 1);
    end = bracket + 1 == text.size() ? std::string_view::npos : bracket + 1;
  } else {
    url.host = text.substr(0, end);
  }
  constexpr std::string_view known = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-:%_";
  if (url.host.empty() || url.host.find_first_not_of(known) != std::string::npos) return {};
  if (end == std::string_view::npos) return url;

  const std::string_view port = text.substr(end);
  const auto [at, error] = std::from_chars(port.data() + 1, port.data() + port.size(), url.port);
  if (!port.starts_with(':') || error != std::errc() || at != port.data() + port.size() || url.port == 0) return {};
  return url;
}

std::string default_url() {
  const char* wanted = std::getenv("PUNCTURA_INVERSE_URL");
  return wanted && *wanted ? wanted : "ws://localhost:10001";
}

}  // namespace punctura::haply
