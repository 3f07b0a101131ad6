// The tick within the HD scheduler: begin frame, read, compute, set force, end frame, errors. Nothing here throws,
// allocates, locks or logs.
#include <chrono>
#include <cmath>

#include "punctura_runtime/backends/openhaptics/openhaptics_tick.hpp"

namespace punctura::hd {

namespace {

constexpr double metre = 1e-3;  // per millimetre

/// The direction of the stylus: the negative third column of its rotation matrix. The library rounds the matrix, so the
/// column is scaled to length 1. One that is far from that length is left for the input gate to refuse.
std::array<double, 3> stylus_axis(const std::array<double, 16>& columns) noexcept {
  const double x = columns[8], y = columns[9], z = columns[10];
  const double length = std::sqrt(x * x + y * y + z * z);
  const double scale = std::abs(length - 1) < 0.01 ? -1 / length : -1;
  return {scale * x, scale * y, scale * z};
}

}  // namespace

Ticking::Ticking(const Session& session, std::int64_t (*now_ns)() noexcept)
    : hd_(session.hd()),
      handle_(session.handle()),
      has_orientation_(session.info().has_orientation),
      tells_temperature_(session.tells_temperature()),
      tells_calibration_(session.tells_calibration()),
      now_ns_(now_ns),
      begin_ns_(now_ns()) {
  sample_.axis = {0, 0, -1};  // without orientation: away from the user
}

void Ticking::begin(Tick tick) noexcept {
  tick_ = tick;
  stopping_ = ended = inside = false;
  ticks = 0;
  farewells_ = 0;
  last_call = now_ns_();
  ending = Ending::none;
}

void Ticking::end() noexcept {
  stop_soon();
  // A tick takes microseconds. A thread of real-time priority that only yields would keep the processor from it.
  while (in_tick_) std::this_thread::sleep_for(std::chrono::microseconds(50));
}

bool Ticking::call() noexcept {
  inside = true;
  const bool more = !ended && one_tick();
  inside = false;
  return more;
}

/// The tick belongs to a loop that may be gone after end().
Tick::Force Ticking::force() noexcept {
  in_tick_ = true;
  const Tick::Force force = stopping_ ? Tick::Force{} : tick_(sample_);
  in_tick_ = false;
  return force;
}

bool Ticking::one_tick() noexcept {
  const std::int64_t now = now_ns_();
  last_call.store(now, std::memory_order_relaxed);
  thread.store(std::this_thread::get_id(), std::memory_order_relaxed);
  if (stopping_ || ending != Ending::none) {
    // Repeated until one was sent: a broken link may recover.
    if (!zero_frame() && ++farewells_ < most_farewells) return true;
    ended = true;
    return false;
  }

  hd_.begin_frame(handle_);
  ErrorInfo error = read();
  const std::uint64_t k = ticks.load(std::memory_order_relaxed);
  const bool lost = tells_calibration_ && k % calibration_every == calibration_every - 1 &&
                    hd_.check_calibration() == calibration_needs_manual_input;
  sample_.time = static_cast<double>(now - begin_ns_) * 1e-9;
  sample_.healthy = error.code == success && !lost;
  const Tick::Force felt = force();
  if (sample_.healthy) hd_.set_doubles(current_force, felt.data());  // a frame without a force sends zero
  hd_.end_frame(handle_);
  const ErrorInfo after = take_errors(hd_, warnings);

  if (sample_.healthy && after.code != success) {  // too late for this tick: reported to the step in one more tick
    error = after;
    ++sample_.sequence;
    sample_.healthy = false;
    force();
  }
  if (!sample_.healthy) leave(error.code == success ? Ending::calibration : Ending::error, error);
  ++sample_.sequence;
  ticks.store(k + 1, std::memory_order_release);
  return true;
}

/// Reads into sample_. It keeps its old values if the library reports an error.
ErrorInfo Ticking::read() noexcept {
  std::array<double, 3> position{not_given, not_given, not_given};
  std::array<double, 16> transform{};
  std::array<double, 16> temperatures{};  // documented: six at most
  int buttons = 0;
  hd_.get_doubles(current_position, position.data());
  if (has_orientation_) hd_.get_doubles(current_transform, transform.data());
  hd_.get_integers(current_buttons, &buttons);
  const bool warmth = tells_temperature_ && ticks.load(std::memory_order_relaxed) % temperature_every == 0;
  if (warmth) hd_.get_doubles(motor_temperature, temperatures.data());

  const ErrorInfo error = take_errors(hd_, warnings);
  if (error.code != success) return error;
  for (std::size_t i = 0; i < 3; ++i) sample_.position[i] = metre * position[i];  // same axes as Punctura
  if (has_orientation_) sample_.axis = stylus_axis(transform);
  sample_.buttons = static_cast<std::uint32_t>(buttons);
  if (warmth) {
    double& hottest = sample_.motor_temperature = 0;
    for (double t : temperatures)
      if (!(t <= hottest || std::isnan(hottest))) hottest = t;  // NaN counts: the input gate refuses it
  }
  return error;
}

/// True if it was sent.
bool Ticking::zero_frame() noexcept {
  hd_.begin_frame(handle_);
  const Tick::Force zero{0, 0, 0};
  hd_.set_doubles(current_force, zero.data());
  hd_.end_frame(handle_);
  return take_errors(hd_, warnings).code == success;
}

/// Ends the force. The next call sends a frame of zeros and is the last.
void Ticking::leave(Ending why, const ErrorInfo& error) noexcept {
  hd_.disable(force_output);
  error_code = error.code;
  error_internal = error.internal;
  ending = why;
}

}  // namespace punctura::hd
