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
  WithoutLock() noexcept : state_(PyEval_SaveThread()) {}
  WithoutLock(const WithoutLock&) = delete;
  ~WithoutLock() {
    begin_to_take();
    PyEval_RestoreThread(state_);
    taking_.fetch_sub(1);
  }

  /// Call in the thread that ends the program (registered with atexit). From then on no other thread takes the GIL.
  static void end_program() {
    last_ = std::this_thread::get_id();
    ends_.store(true);
    PyThreadState* state = PyEval_SaveThread();
    // A thread that did not see ends_ has counted itself before. It gets the GIL now, however busy the computer is.
    while (taking_.load() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    PyEval_RestoreThread(state);
  }

  /// Call in the child of a fork: its other threads do not exist, those that were about to take the GIL included.
  static void begin_child() noexcept { taking_.store(0); }

 private:
  friend class WithLock;

  static void begin_to_take() noexcept {
    taking_.fetch_add(1);
    if (!ends_.load() || std::this_thread::get_id() == last_) return;
    taking_.fetch_sub(1);
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }

  inline static std::atomic<bool> ends_{false};
  inline static std::atomic<int> taking_{0};  ///< threads that take the GIL back now
  inline static std::thread::id last_{};
  PyThreadState* state_;
};

/// Takes the GIL inside a WithoutLock block until the end of this block, with the same answer at program exit.
class WithLock {
 public:
  WithLock() noexcept {
    WithoutLock::begin_to_take();
    state_ = PyGILState_Ensure();
    WithoutLock::taking_.fetch_sub(1);
  }
  WithLock(const WithLock&) = delete;
  ~WithLock() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_{};
};

}  // namespace punctura::bindings
