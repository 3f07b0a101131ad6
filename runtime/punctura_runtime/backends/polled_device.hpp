// The base of a device that Punctura paces: in each period it reads, ticks and writes.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/loop/pacer.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

/// Throws DeviceError if the device already runs in a loop. A second loop would take the ticks of the first one
/// without a message.
inline void refuse_second_loop(bool runs) {
  if (runs) throw DeviceError("the device runs in another loop already: stop that one first");
}

/// It has one thread from start() to stop(), and counts as running until stop(), even if its ticks ended earlier. A
/// derived class calls stop() in its destructor, before its members end.
class PolledDevice : public Device {
 public:
  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  std::vector<std::string> statements() const override { return with_priorities({}); }

  bool finished() const noexcept override { return finished_; }
  std::uint64_t missed() const noexcept { return missed_; }  ///< periods that a late tick has skipped

 protected:
  struct Pacing {
    bool real_time = true;  ///< false: no real-time scheduling, and time counts ticks
    bool waits = true;      ///< false: each tick begins as soon as the last one has ended
    os::RealtimeSettings realtime{};
    LoopClock clock{};
  };
  enum class Next { tick, end, trouble };  ///< end: the last tick was made; trouble: the device is lost

  /// Prepares a run, on the thread of start(). Throws DeviceError.
  virtual void begin() {}
  /// On the ticking thread, before the first tick. If it returns an error, there is none.
  virtual std::string prepare() noexcept { return {}; }
  /// Reads the device into sample_, with its time.
  virtual Next read() noexcept = 0;
  virtual Next write(const Tick::Force& force) noexcept = 0;
  /// Zero force. After trouble, one last tick with healthy = false follows, whose force is not used.
  ///
  /// It runs on any thread: if a tick does not return within `patience` of stop(), the thread of stop() calls it while
  /// that tick is still inside. So it must not touch sample_, and must not wait for the tick.
  virtual void end() noexcept = 0;
  static constexpr std::chrono::milliseconds patience{100};

  std::uint64_t count() const noexcept { return count_; }  ///< ticks of this run so far
  /// Seconds since the run began.
  double now() const noexcept;
  /// With what the system granted the thread, and what not.
  std::vector<std::string> with_priorities(std::vector<std::string> statements) const {
    os::add_words(realtime_, statements);
    return statements;
  }

  DeviceInfo info_;
  Pacing pacing_;
  DeviceSample sample_{};  ///< used by the ticking thread and begin() only

 private:
  /// What the ticking thread does. lost: a tick that did not return; the thread leaves the device alone from then on.
  enum class At { device, tick, over, lost };
  void run(Tick tick) noexcept;

  std::uint64_t count_ = 0;
  std::int64_t start_ns_ = 0;
  std::atomic<bool> finished_{false};
  std::atomic<std::uint64_t> missed_{0};
  std::atomic<bool> stopping_{false};
  std::atomic<At> at_{At::over};
  std::vector<os::RealtimeItem> realtime_;
  std::thread thread_;
};

}  // namespace punctura
