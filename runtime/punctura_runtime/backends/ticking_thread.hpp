// How a device that Punctura paces starts and stops its thread.
#pragma once

#include <atomic>
#include <future>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

/// Throws DeviceError if the device already runs in a loop. A second loop would take the ticks of the first one
/// without a message.
inline void refuse_second_loop(bool runs) {
  if (runs) throw DeviceError("the device runs in another loop already: stop that one first");
}

/// One thread, from start() to stop(). It counts as running until stop(), even if its work ended earlier.
class TickingThread {
 public:
  TickingThread() = default;
  TickingThread(const TickingThread&) = delete;
  TickingThread& operator=(const TickingThread&) = delete;
  ~TickingThread() { stop(); }

  void refuse_second_loop() const { punctura::refuse_second_loop(thread_.joinable()); }

  /// The new thread requests real-time scheduling, if there are settings, and calls prepare(). If that returns true, it
  /// calls run(), which must return soon after stopping() is true. Returns the result of prepare() without waiting for
  /// run(). Throws DeviceError if the thread already runs, or if the system cannot create one.
  template <typename Run, typename Prepare = bool (*)()>
  bool start(const std::optional<os::RealtimeSettings>& realtime, Run run, Prepare prepare = [] { return true; }) {
    refuse_second_loop();
    stopping_ = false;
    std::promise<bool> ready;
    std::future<bool> prepared = ready.get_future();
    try {
      thread_ = std::thread([this, realtime, prepare, run, ready = std::move(ready)]() mutable noexcept {
        realtime_ = realtime ? os::make_realtime(*realtime) : std::vector<os::RealtimeItem>{};
        const bool good = prepare();
        ready.set_value(good);
        if (good) run();
      });
    } catch (const std::system_error& error) {
      throw DeviceError(std::string("no thread for the device's ticks: ") + error.what());
    }
    const bool good = prepared.get();
    if (!good) stop();
    return good;
  }

  /// Waits until run() has returned. Without effect if it does not run.
  void stop() noexcept {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }
  bool stopping() const noexcept { return stopping_; }

  /// What the system granted and what not.
  const std::vector<os::RealtimeItem>& realtime() const noexcept { return realtime_; }

 private:
  std::atomic<bool> stopping_{false};
  std::vector<os::RealtimeItem> realtime_;
  std::thread thread_;
};

}  // namespace punctura
