// The HTTP exchange by which a connection becomes a WebSocket. RFC 6455 section 4.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace punctura::haply {

std::array<std::uint8_t, 20> sha1(std::string_view text);  ///< FIPS 180-4; here a proof of having understood, no secret
std::string base64(std::string_view bytes);                ///< RFC 4648

/// What a server must answer to a key.
std::string accept_for(std::string_view key);

/// The client's question. `key`: base64 of 16 bytes.
std::string upgrade_request(std::string_view authority, std::string_view key);

/// What is wrong with a server's answer (status line and header fields, up to the empty line); empty when it agrees.
std::string upgrade_refusal(std::string_view answer, std::string_view key);

}  // namespace punctura::haply
