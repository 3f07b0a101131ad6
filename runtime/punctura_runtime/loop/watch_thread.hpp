// A thread of this program, not of Python: nothing that a program in Python does can delay it.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#ifndef _WIN32
#include <unistd.h>
#endif

#include "punctura/device/device.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

class TickWatch {
 public:
  /// ticks: before the device was started. now: once it has started, ns.
  void begin(std::uint64_t ticks, std::int64_t now) noexcept {
    first_ = ticks_ = ticks;
    since_ = now;
  }

  /// Seconds without a tick, if the device may not be silent for so long; otherwise 0. deadline: of the gate, s.
  double silent(std::uint64_t ticks, std::int64_t now, const LongestSilence& longest, double deadline) noexcept {
    if (ticks != ticks_) since_ = now;
    ticks_ = ticks;
    const double passed = static_cast<double>(now - since_) * 1e-9;
    const double most = std::max(ticks == first_ ? longest.at_start : longest.later, 5 * deadline);
    return passed < most ? 0 : passed;
  }

 private:
  std::uint64_t first_ = 0, ticks_ = 0;
  std::int64_t since_ = 0;
};

/// Calls look() about 20 times a second, until it returns false, or until stop(). It asks for a real-time priority
/// above the usual one of ticks, so that neither a busy computer nor a tick that does not return holds it up.
class WatchThread {
 public:
  static constexpr std::chrono::milliseconds interval{50};
  static constexpr os::RealtimeSettings priority{
      .priority = 90, .lock_memory = false, .awake = false, .period = std::chrono::duration<double>(interval).count()};

  WatchThread() = default;
  WatchThread(const WatchThread&) = delete;
  WatchThread& operator=(const WatchThread&) = delete;
  ~WatchThread() { stop(); }

  /// Returns when the thread is at work: no run begins unwatched. Throws DeviceError if the system cannot create it.
  template <typename Look>
  void start(Look look) {
    stop();
    end_ = std::make_shared<End>();
    process_ = this_process();
    try {
      thread_ = std::thread([end = end_, look] {
        os::make_realtime(priority);
        std::unique_lock lock(end->mutex);
        end->at_work = true;
        end->wake.notify_all();
        while (!end->wake.wait_for(lock, interval, [&] { return end->asked; })) {
          lock.unlock();
          if (!look()) return;
          lock.lock();
        }
      });
    } catch (const std::system_error& error) {
      throw DeviceError(std::string("no thread to watch the device's ticks: ") + error.what());
    }
    std::unique_lock lock(end_->mutex);
    end_->wake.wait(lock, [this] { return end_->at_work; });
  }

  /// Waits for a look() that is running. Not from look().
  void stop() noexcept {
    if (!thread_.joinable()) return;
    if (process_ != this_process()) {
      // A fork did not copy the thread. glibc 2.43 waits for it forever, and another thread may have its handle now.
      static_cast<void>(new std::thread(std::move(thread_)));
      return;
    }
    {
      const std::lock_guard lock(end_->mutex);
      end_->asked = true;
    }
    end_->wake.notify_one();
    thread_.join();
  }

 private:
  /// Shared with the thread: in the child of a fork, which has no such thread, it is never destroyed. The destructor of
  /// a condition variable would wait there for the thread.
  struct End {
    std::mutex mutex;
    std::condition_variable wake;
    bool at_work = false, asked = false;
  };
  static long this_process() noexcept {
#ifdef _WIN32
    return 0;  // has no fork
#else
    return getpid();
#endif
  }

  std::shared_ptr<End> end_;
  std::thread thread_;
  long process_ = 0;  ///< that of the thread
};

}  // namespace punctura
