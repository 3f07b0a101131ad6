#include "punctura_runtime/backends/haply/url.hpp"

#include <charconv>
#include <cstdlib>

namespace punctura::haply {

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
