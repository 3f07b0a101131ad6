// Where the Inverse Service listens.
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

/// "ws://host", "ws://host:port", "ws://[::1]:port", with or without a slash at the end; nothing when it is none of these.
std::optional<Url> parse_url(std::string_view text);

/// PUNCTURA_INVERSE_URL of the environment, or the service's own default, ws://localhost:10001.
std::string default_url();

}  // namespace punctura::haply
