// Releases the GIL for threads that may still run when the program ends.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace punctura::bindings {

/// Releases the GIL until the end of the block, like nb::gil_scoped_release. But a daemon thread that wants the GIL
/// back during program exit waits here forever: up to version 3.13, Python ends such a thread by unwinding its C++
/// frames, which aborts the process.
class WithoutLock {
 public:
  WithoutLock() noexcept : state_(PyEval_SaveThread()) {
    if (std::this_thread::get_id() != first_) others_.store(true, std::memory_order_relaxed);
  }
  WithoutLock(const WithoutLock&) = delete;
  ~WithoutLock() {
    while (ends_.load() && std::this_thread::get_id() != last_) std::this_thread::sleep_for(std::chrono::hours(1));
    PyEval_RestoreThread(state_);
  }

  /// Call in the thread that ends the program (registered with atexit). From then on no other thread takes the GIL.
  static void end_program() {
    last_ = std::this_thread::get_id();
    ends_.store(true);
    if (!others_.load(std::memory_order_relaxed)) return;
    PyThreadState* state = PyEval_SaveThread();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // threads that already wait for the GIL get it
    PyEval_RestoreThread(state);
  }

 private:
  inline static std::atomic<bool> ends_{false}, others_{false};
  inline static std::thread::id first_ = std::this_thread::get_id(), last_{};
  PyThreadState* state_;
};

}  // namespace punctura::bindings
