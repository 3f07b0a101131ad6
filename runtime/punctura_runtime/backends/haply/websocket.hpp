// A WebSocket client for a service on this machine: text messages with deadlines, no allocation after open().
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "punctura_runtime/backends/haply/frames.hpp"
#include "punctura_runtime/os/socket.hpp"

namespace punctura::haply {

struct Url {
  std::string host;
  std::uint16_t port = 10001;

  std::string text() const { return "ws://" + authority(); }
  std::string authority() const {
    return (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + std::to_string(port);
  }
};

/// "ws://host", "ws://host:port", "ws://[::1]:port", with or without a slash at the end. Nothing for any other text.
std::optional<Url> parse_url(std::string_view text);

/// The environment variable PUNCTURA_INVERSE_URL, or the service's default, ws://localhost:10001.
std::string default_url();

/// RFC 6455 asks for a random key, so that no cache between client and server answers for the server. Between two
/// programs on one machine there is no cache. So the key is the RFC's example, and the answer to it is known: no SHA-1,
/// no base64.
inline constexpr std::string_view upgrade_key = "dGhlIHNhbXBsZSBub25jZQ==",
                                  upgrade_accept = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";

std::string upgrade_request(std::string_view authority);

/// Why a server's answer (status line and header fields, up to the empty line) is refused; empty if it agrees.
std::string upgrade_refusal(std::string_view answer);

/// The result of receive().
enum class Received : std::uint8_t { message, timeout, closed, broken, too_big, failed };

const char* describe(Received how) noexcept;

class WebSocket {
 public:
  static constexpr std::size_t largest_command = 4096, largest_message = 262144;

  WebSocket() : reader_(largest_message), out_(framed_size(largest_command)) {}

  /// Connects. Returns an error message, or nothing. Deadlines are times of os::now_ns().
  std::string open(const Url& url, std::int64_t deadline);
  bool is_open() const noexcept { return static_cast<bool>(socket_); }

  /// False if not all of it was sent before the deadline. The connection is then unusable.
  bool send(std::string_view text, std::int64_t deadline) noexcept { return send(Opcode::text, text, deadline); }

  /// The next text message, valid until the next call. Answers pings.
  Received receive(std::string_view& text, std::int64_t deadline) noexcept;

  /// The server's reason for closing: printable ASCII, at most 123 characters.
  std::string_view close_reason() const noexcept { return {reason_.data(), reason_size_}; }

  /// Sends a close frame if that is possible without waiting, and closes.
  void close() noexcept;

 private:
  bool send(Opcode opcode, std::string_view payload, std::int64_t deadline) noexcept;
  void keep_reason(std::string_view payload) noexcept;

  os::Socket socket_;
  FrameReader reader_;
  std::vector<char> out_;
  /// Masks protect the proxies between client and server (RFC 6455 section 10.3). On one machine there is none: any
  /// generator will do.
  std::minstd_rand mask_;
  std::array<char, 125> reason_{};
  std::size_t reason_size_ = 0;
};

/// GET path. Returns the body, of at most 16 KiB; empty with `error` set if it fails.
std::string http_get(const Url& url, std::string_view path, std::int64_t deadline, std::string& error);

}  // namespace punctura::haply
