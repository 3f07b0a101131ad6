// A device whose readings somebody else's loop brings: a driver written in Python, a simulator that steps at its own pace.
#pragma once

#include <atomic>
#include <mutex>

#include "punctura/device/device.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/latest.hpp"

namespace punctura {

/// Request and reply: every reading that is fed is one tick, on the thread that feeds it, and the reply is the force.
///
/// Who feeds owns the clock, and shall keep to `info().rate`, which is what T is taken from. One thread feeds; it never waits for
/// another one. All other calls may come from any thread. stop() waits until the tick that is under way has ended: when it returns,
/// no tick comes any more.
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

  /// On the thread that feeds, before it begins: asks the system to wake it on time (os::make_realtime, at this device's rate).
  /// What was granted and refused is returned, and is in statements().
  std::vector<std::string> make_realtime(const os::RealtimeSettings& settings = {});

  /// A reading in, the force for the device out, N; zero while no loop runs. A reading that comes while another thread's is being
  /// ticked gets zero and no tick, and statements() says so.
  Tick::Force feed(const Reading& reading) noexcept;
  std::uint64_t fed() const noexcept { return fed_; }  ///< readings since start()

 private:
  /// When readings came, for statements().
  struct Span {
    std::uint64_t readings = 0;
    std::int64_t first_ns = 0, last_ns = 0;
  };
  static constexpr unsigned open = 1, ticking = 2;

  DeviceInfo info_;
  bool real_time_;
  std::mutex starting_or_stopping_;  ///< never of feed()
  std::atomic<unsigned> state_{
      0};  ///< open while a loop runs, ticking while a reading is ticked: who feeds has all below then
  Tick tick_{nullptr, nullptr};
  std::int64_t start_ns_ = 0;
  Span span_;
  mutable Latest<Span> latest_span_;
  std::atomic<std::uint64_t> fed_{0}, refused_{0};
  std::atomic<bool> unhealthy_{false};
  mutable std::mutex words_;  ///< of those who ask, never of feed()
  std::vector<std::string> realtime_;
};

}  // namespace punctura
