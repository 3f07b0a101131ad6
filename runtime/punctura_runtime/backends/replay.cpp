#include "punctura_runtime/backends/replay.hpp"

#include <cmath>

#include "punctura/model/decimal.hpp"
#include "punctura_runtime/loop/pacer.hpp"

namespace punctura {

ReplayDevice::ReplayDevice(std::vector<DeviceSample> samples, DeviceInfo recorded, const ReplayOptions& options)
    : samples_(std::move(samples)), info_(std::move(recorded)), options_(options) {
  if (!(info_.rate > 0) || !std::isfinite(info_.rate))
    throw DeviceError("the rate of a recording must be above 0 Hz, not " + decimal_text(info_.rate));
  // Everything else is the recorded device's: its ratings limit the force, its encoder step selects the conditioning.
  if (info_.backend != "replay") info_.model = info_.model.empty() ? "a recorded motion" : info_.model + ", recorded";
  info_.backend = "replay";
}

void ReplayDevice::start(Tick tick) {
  thread_.refuse_second_loop();
  finished_ = unhealthy_ = false;
  behind_ = 0;
  thread_.start(options_.real_time ? std::optional(options_.realtime.at_rate(info_.rate)) : std::nullopt,
                [this, tick] { run(tick); });
}

void ReplayDevice::stop() noexcept { thread_.stop(); }

std::string ReplayDevice::trouble() const {
  return unhealthy_ ? "the recorded device reported a fault of its own here" : "";
}

std::vector<std::string> ReplayDevice::statements() const {
  std::vector<std::string> all{"the force has no effect on a recorded motion"};
  if (const std::uint64_t periods = behind(); periods > 0)
    all.push_back("the replay is " + std::to_string(periods) + " periods late in total; no sample is missing");
  os::add_words(thread_.realtime(), all);
  return all;
}

void ReplayDevice::run(Tick tick) noexcept {
  Pacer<> pacer(info_.rate);
  for (const DeviceSample& sample : samples_) {
    if (thread_.stopping()) return;
    // A pacer skips times, not samples: a delay stays.
    if (options_.real_time) behind_.fetch_add(pacer.wait(), std::memory_order_relaxed);
    if (!sample.healthy) unhealthy_ = true;
    tick(sample);
  }
  finished_ = true;
}

}  // namespace punctura
