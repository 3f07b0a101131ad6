// A device whose ticks the test makes itself, one after the other, on the test's thread.
#pragma once

#include <cstdint>

#include "core/support/paper_scene.hpp"
#include "punctura/device/device.hpp"

namespace punctura::test {

class HandCranked : public Device {
 public:
  explicit HandCranked(double rate = 1600) {
    info_.backend = "hand-cranked";
    info_.rate = rate;
  }

  const DeviceInfo& info() const noexcept override { return info_; }
  DeviceInfo& described() noexcept { return info_; }
  void start(Tick tick) override { tick_ = tick; }
  void stop() noexcept override { tick_.call = nullptr; }
  LongestSilence longest_silence() const noexcept override { return LongestSilence::any(); }
  const Tick& given() const noexcept { return tick_; }
  bool started() const noexcept { return tick_.call != nullptr; }

  Tick::Force tick(DeviceSample sample) noexcept { return tick_(sample); }
  /// The next reading, at height y (m).
  Tick::Force tick(double y) noexcept {
    ++k_;
    return tick(DeviceSample{k_, static_cast<double>(k_) / info_.rate, {0, y, 0}, {0, -1, 0}, 0, true});
  }
  /// Moves steadily from one height to another.
  Tick::Force move(double from, double to, int ticks) noexcept {
    Tick::Force force{};
    for (int i = 1; i <= ticks; ++i) force = tick(from + (to - from) * i / ticks);
    return force;
  }

 private:
  DeviceInfo info_;
  Tick tick_{};
  std::uint64_t k_ = 0;
};

}  // namespace punctura::test
