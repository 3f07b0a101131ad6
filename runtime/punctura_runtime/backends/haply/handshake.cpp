#include "punctura_runtime/backends/haply/handshake.hpp"

#include <algorithm>

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

}  // namespace punctura::haply
