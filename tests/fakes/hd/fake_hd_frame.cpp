// Frames: the force is zero at the begin of a frame, can be set only inside it, and is sent at its end. One per tick.
#include "fake_hd.hpp"

namespace fake_hd {

namespace {
constexpr std::uint32_t bad_handle = 0x104, comm_error = 0x302, illegal_begin = 0x400, illegal_end = 0x401,
                        frame_error = 0x402;
using Locked = std::lock_guard<std::mutex>;
}  // namespace

void Fake::push(std::uint32_t code, int internal) { errors.push_back({code, internal, current}); }

void Fake::misuse(std::uint32_t code) {
  ++misuses;
  push(code);
}

bool Fake::injected(int fault, unsigned* value) const {
  for (const Injected& i : faults)
    if (i.fault == fault && tick >= i.first && tick - i.first < i.ticks) {
      if (value) *value = i.value;
      return true;
    }
  return false;
}

void Fake::begin_frame(std::uint32_t device) {
  const Locked lock(state);
  if (!open || device != handle_given) return misuse(bad_handle);
  if (in_frame || (one_frame && runs && framed)) return misuse(illegal_begin);
  in_frame = framed = true;
  wanted = {};
  last = reading;
  if (unsigned code = 0; injected(FAKE_HD_ERROR_AT_BEGIN, &code)) push(code, -28);
  if (unplugged) push(comm_error, -28);
}

void Fake::set_force(const double* force) {
  const Locked lock(state);
  if (!in_frame) return misuse(frame_error);
  std::copy(force, force + 3, wanted.begin());
}

void Fake::end_frame(std::uint32_t device) {
  const Locked lock(state);
  if (!open || device != handle_given) return misuse(bad_handle);
  if (!in_frame) return misuse(illegal_end);
  in_frame = false;
  if (unplugged) return push(comm_error, -28);
  if (unsigned code = 0; injected(FAKE_HD_ERROR_AT_END, &code)) {
    push(code, -28);
    if (code < 0x200 || code > 0x203) return;  // not sent: the motors keep the last force
  }
  held = force_output ? wanted : std::array<double, 3>{};
}

}  // namespace fake_hd
