#include "punctura_runtime/backends/fed.hpp"

#include <cmath>

#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/polled_device.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

namespace {
constexpr double tolerance = 0.05;  // relative error of the rate above which the user is told
}

FedDevice::FedDevice(DeviceInfo info, bool real_time) : info_(std::move(info)), real_time_(real_time) {
  require_rate(info_.rate, "the rate of a fed device");
  if (info_.backend.empty()) info_.backend = "fed";
}

void FedDevice::start(Tick tick) {
  const std::lock_guard one(starting_or_stopping_);
  refuse_second_loop((state_ & open) != 0);
  tick_ = tick;
  fed_ = refused_ = 0;
  unhealthy_ = false;
  start_ns_ = os::now_ns();
  span_ = {};
  latest_span_.write([](Span& to) { to = {}; });
  state_.store(open, std::memory_order_release);
}

void FedDevice::stop() noexcept {
  const std::lock_guard one(starting_or_stopping_);
  state_.fetch_and(~open);
  // A tick takes microseconds, or as long as the system keeps its thread waiting.
  while ((state_.load(std::memory_order_acquire) & ticking) != 0) os::sleep_until_ns(os::now_ns() + 50'000);
}

Tick::Force FedDevice::feed(const Reading& reading) noexcept {
  unsigned state = open;
  if (!state_.compare_exchange_strong(state, open | ticking)) {
    if (state & ticking) refused_.fetch_add(1, std::memory_order_relaxed);
    return {0, 0, 0};
  }
  const std::int64_t now = os::now_ns();
  const std::uint64_t k = span_.readings;
  if (k == 0) span_.first_ns = now;
  span_.last_ns = now;
  span_.readings = k + 1;
  if (!reading.healthy) unhealthy_ = true;
  const double time = real_time_ ? static_cast<double>(now - start_ns_) * 1e-9 : static_cast<double>(k) / info_.rate;
  const Tick::Force force =
      tick_({k, time, reading.position, reading.axis, reading.buttons, reading.healthy, reading.motor_temperature});
  fed_.store(k + 1, std::memory_order_relaxed);
  latest_span_.write([this](Span& to) { to = span_; });
  state_.fetch_and(~ticking, std::memory_order_release);
  return force;
}

std::string FedDevice::trouble() const {
  return unhealthy_ ? "a reading was fed with healthy = false: the device reports a problem" : "";
}

std::vector<std::string> FedDevice::make_realtime(const os::RealtimeSettings& settings) {
  std::vector<std::string> lines;
  os::add_words(os::make_realtime(settings.at_rate(info_.rate)), lines);
  const std::lock_guard lock(words_);
  realtime_ = lines;
  return lines;
}

std::vector<std::string> FedDevice::statements() const {
  const std::lock_guard lock(words_);
  std::vector<std::string> all = realtime_;
  if (const std::uint64_t n = refused_; n > 0)
    all.push_back(std::to_string(n) +
                  " readings got no tick and no force, because two threads fed the device at the same time");
  const Span span = latest_span_.read();
  if (!real_time_ || span.readings < 2) return all;
  const double rate =
      static_cast<double>(span.readings - 1) / (static_cast<double>(span.last_ns - span.first_ns) * 1e-9);
  const bool off = !(std::abs(rate - info_.rate) <= tolerance * info_.rate);
  all.push_back("fed at " + decimal_text(rate, 4) + " Hz" +
                (off ? ", not at the rate that it was opened with: damping and filters are wrong by as much" : ""));
  if (realtime_.empty()) all.push_back("the feeding thread has no real-time priority: call make_realtime() on it");
  return all;
}

}  // namespace punctura
