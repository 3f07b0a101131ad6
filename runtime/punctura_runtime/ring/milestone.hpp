// How far another thread has come.
#pragma once

#include <condition_variable>
#include <mutex>

namespace punctura {

/// One thread waits until another has come that far. std::atomic::wait would do, but for GCC 12's library, which misses the call now and
/// then where the system has no futex (mingw-w64; seen under Wine).
class Milestone {
 public:
  void set_ahead() {
    const std::lock_guard lock(mutex_);
    reached_ = false;
  }
  void reach() {
    const std::lock_guard lock(mutex_);
    reached_ = true;
    changed_.notify_all();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return reached_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool reached_ = false;
};

}  // namespace punctura
