#include "punctura_runtime/backends/haply/frames.hpp"

#include <algorithm>
#include <cstring>

namespace punctura::haply {

std::size_t write_frame(Opcode opcode, std::string_view payload, std::uint32_t mask, std::span<char> out) noexcept {
  std::size_t n = 0;
  const auto put = [&](std::uint64_t byte) { out[n++] = static_cast<char>(byte & 0xff); };
  put(0x80u | static_cast<unsigned>(opcode));  // final: each message is one frame
  const std::uint64_t size = payload.size();
  if (size < 126) {
    put(0x80u | size);
  } else if (size < 0x10000) {
    put(0x80u | 126u);
    put(size >> 8);
    put(size);
  } else {
    put(0x80u | 127u);
    for (int shift = 56; shift >= 0; shift -= 8) put(size >> shift);
  }
  for (int shift = 24; shift >= 0; shift -= 8) put(mask >> shift);
  for (std::size_t i = 0; i < payload.size(); ++i)
    put(static_cast<unsigned char>(payload[i]) ^ (mask >> (24 - 8 * (i % 4))));
  return n;
}

std::span<char> FrameReader::space() noexcept {
  if (begin_ > 0) {
    std::memmove(input_.data(), input_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  return {input_.data() + end_, input_.size() - end_};
}

Event FrameReader::fail(Event why) noexcept { return failed_ = why; }

/// Reads the header of a frame once all of it has arrived, and sets in_frame_.
Event FrameReader::header() noexcept {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>(input_[begin_ + i]));
  };
  const std::size_t there = end_ - begin_;
  if (there < 2) return Event::more;
  const std::uint64_t first = byte(0), second = byte(1), short_size = second & 0x7f;
  if ((first & 0x70) != 0) return fail(Event::broken);   // an extension that was not negotiated
  if ((second & 0x80) != 0) return fail(Event::broken);  // a server must not mask
  const std::size_t size_bytes = short_size == 126 ? 2 : short_size == 127 ? 8 : 0;
  if (there < 2 + size_bytes) return Event::more;

  std::uint64_t size = size_bytes == 0 ? short_size : 0;
  for (std::size_t i = 0; i < size_bytes; ++i) size = size << 8 | byte(2 + i);
  if (size_bytes == 2 && size < 126) return fail(Event::broken);      // only the shortest form is allowed
  if (size_bytes == 8 && size < 0x10000) return fail(Event::broken);  // likewise
  if ((size >> 63) != 0) return fail(Event::broken);

  final_ = (first & 0x80) != 0;
  switch (first & 0x0f) {
    case 0:
      if (!in_message_) return fail(Event::broken);
      break;
    case 1:
    case 2:
      if (in_message_) return fail(Event::broken);
      in_message_ = true;
      message_is_text_ = (first & 0x0f) == 1;
      message_size_ = 0;
      break;
    case 8:
    case 9:
    case 10:
      if (!final_ || size > control_.size()) return fail(Event::broken);
      control_size_ = 0;
      break;
    default: return fail(Event::broken);
  }
  opcode_ = static_cast<Opcode>(first & 0x0f);
  if (opcode_ < Opcode::close && size > message_.size() - message_size_) return fail(Event::too_big);
  begin_ += 2 + size_bytes;
  left_ = size;
  in_frame_ = true;
  return Event::more;
}

Event FrameReader::next(std::string_view& payload) noexcept {
  for (;;) {
    if (failed_ != Event::more) return failed_;
    if (!in_frame_ && (header() != Event::more || !in_frame_)) return failed_;

    const bool control = opcode_ >= Opcode::close;
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(left_, end_ - begin_));
    char* to = control ? control_.data() + control_size_ : message_.data() + message_size_;
    if (n > 0) std::memcpy(to, input_.data() + begin_, n);
    (control ? control_size_ : message_size_) += n;
    begin_ += n;
    left_ -= n;
    if (left_ > 0) return Event::more;
    in_frame_ = false;

    if (control) {
      payload = {control_.data(), control_size_};
      return opcode_ == Opcode::ping ? Event::ping : opcode_ == Opcode::pong ? Event::pong : Event::close;
    }
    if (final_) {
      in_message_ = false;
      payload = {message_.data(), message_size_};
      return message_is_text_ ? Event::text : Event::binary;
    }
  }
}

}  // namespace punctura::haply
