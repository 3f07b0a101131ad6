// WebSocket frames, as a client sends and reads them. RFC 6455 section 5; no I/O here, so that it can be fed anything.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace punctura::haply {

enum class Opcode : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// The largest frame that write_frame() makes of a payload.
constexpr std::size_t framed_size(std::size_t payload) noexcept { return payload + 14; }

/// A whole masked frame into `out`, which must have framed_size(payload.size()) bytes. Gives its size.
std::size_t write_frame(Opcode opcode, std::string_view payload, std::uint32_t mask, std::span<char> out) noexcept;

/// What came, once enough bytes have come.
enum class Event : std::uint8_t {
  more,    ///< nothing yet: receive more bytes
  text,    ///< a whole message, its fragments put together
  binary,  ///< the same, not text
  ping,
  pong,
  close,
  broken,   ///< the other side does not speak as RFC 6455 wants; nothing can be read any more
  too_big,  ///< a message beyond the limit; nothing can be read any more
};

/// Cuts what comes over a connection, in pieces of any size, into messages. Takes all its memory when it is made.
class FrameReader {
 public:
  explicit FrameReader(std::size_t largest_message) : message_(largest_message) {}

  /// Where the next bytes are to be put; never empty while next() has said `more`.
  std::span<char> space() noexcept;
  void filled(std::size_t bytes) noexcept { end_ += bytes; }

  /// The next thing that came. The payload stays until the next call. Ask again until it says `more`.
  Event next(std::string_view& payload) noexcept;

 private:
  Event header() noexcept;
  Event fail(Event why) noexcept;

  std::array<char, 16384> input_{};
  std::size_t begin_ = 0, end_ = 0;

  // The frame being read: so much of its payload is still to come.
  bool in_frame_ = false, final_ = false;
  Opcode opcode_ = Opcode::continuation;
  std::uint64_t left_ = 0;

  std::array<char, 125> control_{};
  std::size_t control_size_ = 0;
  std::vector<char> message_;
  std::size_t message_size_ = 0;
  bool in_message_ = false, message_is_text_ = false;
  Event failed_ = Event::more;
};

}  // namespace punctura::haply
