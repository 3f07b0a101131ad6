// WebSocket frames as a client writes and reads them (RFC 6455 section 5), without input or output.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace punctura::haply {

enum class Opcode : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// The largest frame that write_frame() writes for a payload.
constexpr std::size_t framed_size(std::size_t payload) noexcept { return payload + 14; }

/// Writes a whole masked frame into `out`, which must have framed_size(payload.size()) bytes. Returns its size.
std::size_t write_frame(Opcode opcode, std::string_view payload, std::uint32_t mask, std::span<char> out) noexcept;

/// What FrameReader has found in the bytes so far.
enum class Event : std::uint8_t {
  more,    ///< nothing complete: receive more bytes
  text,    ///< a whole text message, of one or more fragments
  binary,  ///< a whole binary message
  ping,
  pong,
  close,
  broken,   ///< a violation of RFC 6455; nothing can be read after it
  too_big,  ///< a message beyond the limit; nothing can be read after it
};

/// Assembles messages from received pieces of any size. Allocates in its constructor only.
class FrameReader {
 public:
  explicit FrameReader(std::size_t largest_message) : message_(largest_message) {}

  /// Where to put the next bytes; never empty after next() has returned `more`.
  std::span<char> space() noexcept;
  void filled(std::size_t bytes) noexcept { end_ += bytes; }

  /// The next event. The payload is valid until the next call. Call it until it returns `more`.
  Event next(std::string_view& payload) noexcept;

 private:
  Event header() noexcept;
  Event fail(Event why) noexcept;

  std::array<char, 16384> input_{};
  std::size_t begin_ = 0, end_ = 0;

  // The frame that is being read; left_: bytes of its payload that are missing.
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
