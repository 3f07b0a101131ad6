#include "punctura_runtime/backends/fed.hpp"

#include <cmath>
#include <cstdio>

#include "punctura_runtime/backends/ticking_thread.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

namespace {
constexpr double tolerance = 0.05;  // of the rate, above which the user is told
}

FedDevice::FedDevice(DeviceInfo info, bool real_time) : info_(std::move(info)), real_time_(real_time) {
  if (!(info_.rate > 0) || !std::isfinite(info_.rate))
    throw DeviceError("a rate of " + std::to_string(info_.rate) + " Hz cannot be fed: it must be above 0");
  if (info_.backend.empty()) info_.backend = "fed";
}

void FedDevice::start(Tick tick) {
  const std::lock_guard lock(one_at_a_time_);
  refuse_second_loop(tick_.call != nullptr);
  tick_ = tick;
  fed_ = 0;
  unhealthy_ = false;
  start_ns_ = os::now_ns();
}

void FedDevice::stop() noexcept {
  const std::lock_guard lock(one_at_a_time_);
  tick_.call = nullptr;
}

Tick::Force FedDevice::feed(const Reading& reading) noexcept {
  const std::lock_guard lock(one_at_a_time_);
  if (tick_.call == nullptr) return {0, 0, 0};
  const std::uint64_t k = fed_.load(std::memory_order_relaxed);
  last_ns_ = os::now_ns();
  if (k == 0) first_ns_ = last_ns_;
  if (!reading.healthy) unhealthy_ = true;
  const double time =
      real_time_ ? static_cast<double>(last_ns_ - start_ns_) * 1e-9 : static_cast<double>(k) / info_.rate;
  const Tick::Force force =
      tick_({k, time, reading.position, reading.axis, reading.buttons, reading.healthy, reading.motor_temperature});
  fed_.store(k + 1, std::memory_order_relaxed);
  return force;
}

std::string FedDevice::trouble() const { return unhealthy_ ? "who feeds the device said that it is not healthy" : ""; }

std::vector<std::string> FedDevice::statements() const {
  const std::lock_guard lock(one_at_a_time_);
  const std::uint64_t n = fed_;
  if (!real_time_ || n < 2) return {};
  const double rate = static_cast<double>(n - 1) / (static_cast<double>(last_ns_ - first_ns_) * 1e-9);
  char text[160];
  const bool off = !(std::abs(rate - info_.rate) <= tolerance * info_.rate);
  std::snprintf(text, sizeof text, "fed at %.4g Hz%s", rate,
                off ? ", not at the rate that it was opened with: damping and filters are wrong by as much" : "");
  return {text};
}

}  // namespace punctura
