// The tick within the HD scheduler: begin frame, read, compute, set force, end frame, errors. Nothing here throws,
// allocates, locks or logs.
#include <cmath>

#include "punctura_runtime/backends/openhaptics/openhaptics.hpp"

namespace punctura {

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

std::uint32_t OpenHapticsDevice::call(void* self) noexcept {
  auto* device = static_cast<OpenHapticsDevice*>(self);
  device->inside_ = true;
  const bool more = !device->ended_ && device->one_tick();
  device->inside_ = false;  // from here on the device may be destroyed
  return more ? hd::again : hd::done;
}

bool OpenHapticsDevice::one_tick() noexcept {
  const std::int64_t now = options_.now_ns();
  last_call_.store(now, std::memory_order_relaxed);
  ticking_thread_.store(std::this_thread::get_id(), std::memory_order_relaxed);
  if (stopping_ || ending_ != Ending::none) {
    // Repeated until one was sent: a broken link may recover.
    if (!zero_frame() && ++farewells_ < most_farewells) return true;
    ended_ = true;
    return false;
  }

  hd_.begin_frame(session_.handle());
  hd::ErrorInfo error = read();
  const std::uint64_t k = ticks_.load(std::memory_order_relaxed);
  const bool lost = session_.tells_calibration() && k % calibration_every == calibration_every - 1 &&
                    hd_.check_calibration() == hd::calibration_needs_manual_input;
  sample_.time = static_cast<double>(now - begin_ns_) * 1e-9;
  sample_.healthy = error.code == hd::success && !lost;
  const Tick::Force force = tick_(sample_);
  if (sample_.healthy) give(force);  // a frame without a force sends zero
  hd_.end_frame(session_.handle());
  const hd::ErrorInfo after = hd::take_errors(hd_, warnings_);

  if (sample_.healthy && after.code != hd::success) {  // too late for this tick: reported to the step in one more tick
    error = after;
    ++sample_.sequence;
    sample_.healthy = false;
    tick_(sample_);
  }
  if (!sample_.healthy) leave(error.code == hd::success ? Ending::calibration : Ending::error, error);
  ++sample_.sequence;
  ticks_.store(k + 1, std::memory_order_release);
  return true;
}

/// Reads into sample_. It keeps its old values if the library reports an error.
hd::ErrorInfo OpenHapticsDevice::read() noexcept {
  std::array<double, 3> position{unknown, unknown, unknown};
  std::array<double, 16> transform{};
  std::array<double, 16> temperatures{};  // documented: six at most
  int buttons = 0;
  hd_.get_doubles(hd::current_position, position.data());
  if (info_.has_orientation) hd_.get_doubles(hd::current_transform, transform.data());
  hd_.get_integers(hd::current_buttons, &buttons);
  const bool warmth = session_.tells_temperature() && ticks_.load(std::memory_order_relaxed) % temperature_every == 0;
  if (warmth) hd_.get_doubles(hd::motor_temperature, temperatures.data());

  const hd::ErrorInfo error = hd::take_errors(hd_, warnings_);
  if (error.code != hd::success) return error;
  for (std::size_t i = 0; i < 3; ++i) sample_.position[i] = metre * position[i];  // same axes as Punctura
  if (info_.has_orientation) sample_.axis = stylus_axis(transform);
  sample_.buttons = static_cast<std::uint32_t>(buttons);
  if (warmth) {
    sample_.motor_temperature = 0;
    for (double t : temperatures)
      if (t > sample_.motor_temperature) sample_.motor_temperature = t;
  }
  return error;
}

/// Inside a frame only. The last guard before the device, whatever the tick returns.
void OpenHapticsDevice::give(const Tick::Force& force) noexcept {
  const bool sound = std::isfinite(force[0]) && std::isfinite(force[1]) && std::isfinite(force[2]);
  const Tick::Force zero{0, 0, 0};
  hd_.set_doubles(hd::current_force, sound ? force.data() : zero.data());
}

/// True if it was sent.
bool OpenHapticsDevice::zero_frame() noexcept {
  hd_.begin_frame(session_.handle());
  give({0, 0, 0});
  hd_.end_frame(session_.handle());
  return hd::take_errors(hd_, warnings_).code == hd::success;
}

/// Ends the force. The next call sends a frame of zeros and is the last.
void OpenHapticsDevice::leave(Ending why, const hd::ErrorInfo& error) noexcept {
  hd_.disable(hd::force_output);
  error_code_ = error.code;
  error_internal_ = error.internal;
  ending_ = why;
}

}  // namespace punctura
