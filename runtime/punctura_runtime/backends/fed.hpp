// A device whose readings somebody else's loop brings: a driver written in Python, a simulator that steps at its own pace.
#pragma once

#include <atomic>
#include <mutex>

#include "punctura/device/device.hpp"

namespace punctura {

/// Request and reply: every reading that is fed is one tick, on the thread that feeds it, and the reply is the force.
///
/// Who feeds owns the clock, and shall keep to `info().rate`, which is what T is taken from. The lock stands between feeding and
/// stopping, outside of the tick: when stop() returns, no tick comes any more.
class FedDevice : public Device {
 public:
  struct Reading {
    std::array<double, 3> position;        ///< m
    std::array<double, 3> axis{0, -1, 0};  ///< unit direction in which the needle points
    std::uint32_t buttons = 0;             ///< one bit each
    bool healthy = true;                   ///< false: who feeds has lost the device
    double motor_temperature = 0;          ///< 0 to 1
  };

  /// info: what the device is, its rate among it. real_time: readings get the time at which they are fed; false: k / rate, for
  /// who simulates and is not bound to the clock. Throws DeviceError where the rate is none.
  explicit FedDevice(DeviceInfo info, bool real_time = true);
  ~FedDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

  /// A reading in, the force for the device out, N; zero while no loop runs.
  Tick::Force feed(const Reading& reading) noexcept;
  std::uint64_t fed() const noexcept { return fed_; }  ///< readings since start()

 private:
  DeviceInfo info_;
  bool real_time_;
  mutable std::mutex one_at_a_time_;
  Tick tick_{nullptr, nullptr};
  std::int64_t start_ns_ = 0, first_ns_ = 0, last_ns_ = 0;
  std::atomic<std::uint64_t> fed_{0};
  std::atomic<bool> unhealthy_{false};
};

}  // namespace punctura
