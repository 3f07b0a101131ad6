#include "punctura_runtime/backends/haply/frames.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "punctura_runtime/backends/haply/websocket.hpp"

using namespace punctura::haply;

namespace {

/// The frames read from these bytes, in pieces of the given size: one letter for each frame, and the payloads.
std::string read(const std::string& bytes, std::size_t piece, std::size_t limit = 1000) {
  FrameReader reader(limit);
  std::string events;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto space = reader.space();
    const std::size_t n = std::min({piece, space.size(), bytes.size() - at});
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), n, space.begin());
    reader.filled(n);
    at += n;
    for (;;) {
      std::string_view payload;
      const Event event = reader.next(payload);
      if (event == Event::more) break;
      events += "mtbPpcXL"[static_cast<int>(event)];
      if (event == Event::broken || event == Event::too_big) return events;
      events += std::string(payload) + ";";
    }
  }
  return events;
}

std::string all_sizes(const std::string& bytes, std::size_t limit = 1000) {
  const std::string whole = read(bytes, 1 << 20, limit);
  for (std::size_t piece : {1u, 2u, 3u, 7u}) CHECK(read(bytes, piece, limit) == whole);
  return whole;
}

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (int value : values) text += static_cast<char>(value);
  return text;
}

}  // namespace

TEST_CASE("the examples of RFC 6455 section 5.7 are read, in pieces of any size") {
  CHECK(all_sizes("\x81\x05Hello") == "tHello;");
  CHECK(all_sizes("\x01\x03Hel\x80\x02lo") == "tHello;");
  CHECK(all_sizes("\x89\x05Hello\x8a\x05Hello") == "PHello;pHello;");
  CHECK(all_sizes(bytes({0x82, 126, 1, 0}) + std::string(256, 'x')) == "b" + std::string(256, 'x') + ";");
  CHECK(all_sizes(bytes({0x82, 127, 0, 0, 0, 0, 0, 1, 0, 0}) + std::string(65536, 'x'), 65536) ==
        "b" + std::string(65536, 'x') + ";");
}

TEST_CASE("control frames may come between fragments, and one read may contain several messages") {
  CHECK(all_sizes("\x01\x01"
                  "a"
                  "\x89\x01"
                  "?"
                  "\x00\x01"
                  "b" +
                  bytes({0x80, 0, 0x81, 1, 'c', 0x88, 2, 3, 0xe8}))
            .starts_with("P?;"));
  CHECK(all_sizes(bytes({1, 1, 'a', 0x89, 1, '?', 0, 1, 'b', 0x80, 0, 0x81, 1, 'c', 0x81, 0, 0x88, 2, '3', '!'})) ==
        "P?;tab;tc;t;c3!;");
}

TEST_CASE("a frame that RFC 6455 forbids ends the connection") {
  CHECK(all_sizes(bytes({0x81, 0x81, 0, 0, 0, 0, 'a'})) == "X");  // masked by a server
  CHECK(all_sizes(bytes({0xc1, 0})) == "X");                      // an extension's bit
  CHECK(all_sizes(bytes({0x83, 0})) == "X");                      // a reserved opcode
  CHECK(all_sizes(bytes({0x8b, 0})) == "X");
  CHECK(all_sizes(bytes({0x80, 0})) == "X");            // a continuation of nothing
  CHECK(all_sizes(bytes({0x01, 0, 0x81, 0})) == "X");   // a message within a message
  CHECK(all_sizes(bytes({0x09, 0})) == "X");            // a ping in fragments
  CHECK(all_sizes(bytes({0x89, 126, 0, 126})) == "X");  // a long ping
  CHECK(all_sizes(bytes({0x81, 126, 0, 125})) == "X");  // not the shortest length
  CHECK(all_sizes(bytes({0x81, 127, 0, 0, 0, 0, 0, 0, 0xff, 0xff})) == "X");
  CHECK(all_sizes(bytes({0x81, 127, 0x80, 0, 0, 0, 0, 0, 0, 0})) == "X");
}

TEST_CASE("a message over the size limit is refused before it is read, also in fragments") {
  CHECK(all_sizes(bytes({0x81, 126, 3, 0xe8}) + std::string(1000, 'x')).size() == 1002);
  CHECK(all_sizes(bytes({0x81, 126, 3, 0xe9})) == "L");
  CHECK(all_sizes(bytes({0x81, 127, 0x7f, 0, 0, 0, 0, 0, 0, 0})) == "L");
  CHECK(all_sizes(bytes({0x01, 126, 3, 0xe8}) + std::string(1000, 'x') + bytes({0x80, 1})) == "L");
}

TEST_CASE("written frames are masked, complete, and have the shortest length field") {
  std::string out(framed_size(70000), '\0');
  CHECK(out.substr(0, write_frame(Opcode::text, "Hello", 0x37fa213d, out)) ==
        bytes({0x81, 0x85, 0x37, 0xfa, 0x21, 0x3d, 0x7f, 0x9f, 0x4d, 0x51, 0x58}));  // RFC 6455 section 5.7
  CHECK(write_frame(Opcode::text, std::string(125, 'x'), 1, out) == 131);
  CHECK(write_frame(Opcode::text, std::string(126, 'x'), 1, out) == 134);
  CHECK(write_frame(Opcode::text, std::string(65536, 'x'), 1, out) == 65536 + 14);
  CHECK(out.substr(0, 10) == bytes({0x81, 0xff, 0, 0, 0, 0, 0, 1, 0, 0}));
}

TEST_CASE("the server's handshake is accepted only in the form of RFC 6455") {
  CHECK(upgrade_request("localhost:1").find("Host: localhost:1\r\n") != std::string::npos);
  CHECK(upgrade_request("localhost:1").find("Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n") != std::string::npos);

  const std::string head =
      "HTTP/1.1 101 x\r\nupgrade: WebSocket\r\nCONNECTION: keep-alive, Upgrade\r\nSec-WebSocket-Accept: ";
  const std::string good = head + "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";  // section 1.3: the answer to that key
  CHECK(upgrade_refusal(good) == "");
  CHECK(upgrade_refusal(head + "s3pPLMBiTxaQ9kYGzzhZRbK+xOp=").find("Sec-WebSocket-Accept") != std::string::npos);
  CHECK(upgrade_refusal(good + "\r\nSec-WebSocket-Extensions: permessage-deflate").find("extension") !=
        std::string::npos);
  CHECK(upgrade_refusal("HTTP/1.1 101 x\r\nSec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=").find("refused") !=
        std::string::npos);
  CHECK(upgrade_refusal("HTTP/1.1 404 \x1b[31mNot\r\n") ==
        "it answered \"HTTP/1.1 404 ?[31mNot\" to the request for a WebSocket");
  CHECK(upgrade_refusal("") != "");
}
