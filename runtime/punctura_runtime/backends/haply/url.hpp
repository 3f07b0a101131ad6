// The address of the Inverse Service.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace punctura::haply
