// A thread of this program, not of Python: nothing that a program in Python does can delay it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

#include "punctura/device/device.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

/// Calls look() about 20 times a second, until it returns false, or until stop(). It asks for a low real-time priority,
/// so that a busy computer does not hold it up.
class WatchThread {
 public:
  static constexpr std::chrono::milliseconds interval{50};
  static constexpr os::RealtimeSettings priority{
      .priority = 10, .lock_memory = false, .awake = false, .period = std::chrono::duration<double>(interval).count()};

  WatchThread() = default;
  WatchThread(const WatchThread&) = delete;
  WatchThread& operator=(const WatchThread&) = delete;
  ~WatchThread() { stop(); }

  /// Throws DeviceError if the system cannot create a thread.
  template <typename Look>
  void start(Look look) {
    stop();
    over_ = false;
    try {
      thread_ = std::thread([this, look] {
        os::make_realtime(priority);
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, interval, [this] { return over_; })) {
          lock.unlock();
          if (!look()) return;
          lock.lock();
        }
      });
    } catch (const std::system_error& error) {
      throw DeviceError(std::string("no thread to watch the device's ticks: ") + error.what());
    }
  }

  /// Waits for a look() that is running. Not from look().
  void stop() noexcept {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace punctura
