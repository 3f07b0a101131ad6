// A device whose readings come from another loop: a driver written in Python, or a simulator with its own time.
#pragma once

#include <atomic>
#include <mutex>

#include "punctura/device/device.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/handover.hpp"

namespace punctura {

/// Request and reply: each call of feed() is one tick, on the calling thread, and returns the force.
///
/// The feeding thread owns the clock. It must keep to `info().rate`, from which T is computed. Only one thread feeds;
/// it never waits for another one. All other calls are allowed from any thread. stop() waits for the running tick;
/// after it no tick runs.
class FedDevice : public Device {
 public:
  struct Reading {
    std::array<double, 3> position;        ///< m
    std::array<double, 3> axis{0, -1, 0};  ///< unit direction in which the needle points
    std::uint32_t buttons = 0;             ///< one bit each
    bool healthy = true;                   ///< false: the device is lost
    double motor_temperature = 0;          ///< 0 to 1
  };

  /// real_time: each reading gets the time of its call; false: k / rate, for a simulation that does not follow the
  /// clock. Throws DeviceError if the rate in `info` is not above 0.
  explicit FedDevice(DeviceInfo info, bool real_time = true);
  ~FedDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  /// The feeding program may be held up, most of all before its first reading.
  LongestSilence longest_silence() const noexcept override {
    return real_time_ ? LongestSilence{30, 1} : LongestSilence::any();
  }
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

  /// To be called on the feeding thread before the first reading: requests real-time scheduling (os::make_realtime) at
  /// this device's rate. Returns what was granted and what was refused; statements() has it, too.
  std::vector<std::string> make_realtime(const os::RealtimeSettings& settings = {});

  /// Takes a reading and returns the force for the device, N; zero while no loop runs. A reading that comes while
  /// another thread's tick runs gets no tick and zero force, and statements() says so.
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
  std::mutex starting_or_stopping_;  ///< not used by feed()
  std::atomic<unsigned> state_{
      0};  ///< open: a loop runs; ticking: a tick runs, and the feeding thread owns all members below
  Tick tick_{};
  std::int64_t start_ns_ = 0;
  Span span_;
  mutable TripleBuffer<Span> latest_span_;
  std::atomic<std::uint64_t> fed_{0}, refused_{0};
  std::atomic<bool> unhealthy_{false};
  mutable std::mutex words_;  ///< guards realtime_; not used by feed()
  std::vector<std::string> realtime_;
};

}  // namespace punctura
