// What the scheduler's thread works on, which it may use longer than its owner.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

namespace punctura::hd {

/// The object of an operation. `bool call()` is called in each tick, until it returns false.
struct Work {
  std::atomic<bool> left{true};  ///< the scheduler's thread will not use it any more
};

/// Frees a Work if the scheduler has left it. Otherwise it stays for ever: a call that hangs in the driver may go on
/// later, and none of the library's functions waits for it.
struct FreeIfLeft {
  template <typename T>
  void operator()(T* work) const {
    if (work->left.load(std::memory_order_acquire)) return delete work;
    static auto& mutex = *new std::mutex;
    static auto& kept = *new std::vector<const Work*>;  // still reachable, for tools that look for leaks
    const std::lock_guard lock(mutex);
    kept.push_back(work);
  }
};
template <typename T>
using Lent = std::unique_ptr<T, FreeIfLeft>;

/// The operation itself.
template <typename T>
std::uint32_t call_work(void* lent) {
  T* const work = static_cast<T*>(lent);
  if (work->call()) return again;
  work->left.store(true, std::memory_order_release);  // last: it may be freed from now on
  return done;
}

template <typename T>
OperationHandle schedule(const Interface& hd, const Lent<T>& work) {
  work->left = false;
  return hd.schedule(&call_work<T>, work.get(), highest_priority);
}

}  // namespace punctura::hd
