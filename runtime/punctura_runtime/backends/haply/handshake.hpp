// The HTTP exchange that turns a connection into a WebSocket. RFC 6455 section 4.
#pragma once

#include <string>
#include <string_view>

namespace punctura::haply {

/// RFC 6455 asks for a random key, so that no cache between client and server answers for the server. Between two
/// programs on one machine there is no cache. So the key is the RFC's example, and the answer to it is known: no SHA-1,
/// no base64.
inline constexpr std::string_view upgrade_key = "dGhlIHNhbXBsZSBub25jZQ==",
                                  upgrade_accept = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";

std::string upgrade_request(std::string_view authority);

/// Why a server's answer (status line and header fields, up to the empty line) is refused; empty if it agrees.
std::string upgrade_refusal(std::string_view answer);

}  // namespace punctura::haply
