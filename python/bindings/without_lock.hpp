// Releases the GIL for threads that may still run when the program ends.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace punctura::bindings {

/// Threads at the end of the program. Up to version 3.13, Python ends a daemon thread that wants the GIL during exit
/// by unwinding the thread's frames, which aborts the process if C++ frames are among them. Therefore the thread that
/// ends the program waits until no other thread is in a call of this module. From then on a call that releases the GIL
/// does not end. A short call, which does not release it, works until the exit: a handler of atexit can wait for it.
///
/// Where Python has no GIL, a thread is attached where this file says that it holds the GIL.
class EndOfProgram {
 public:
  /// Call in the thread that ends the program (registered with atexit).
  static void begin() {
    last_ = std::this_thread::get_id();
    ends_.store(true);
    const int own = depth_ > 0 ? 1 : 0;
    // Limited, because a function of the user, such as `progress`, may never return.
    for (int ms = 0; ms < 2000 && (taking_.load() > 0 || calls_.load() > own); ++ms) {
      PyThreadState* state = PyEval_SaveThread();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      PyEval_RestoreThread(state);
    }
  }

  /// Call in the child of a fork, where the other threads of the parent do not exist.
  static void begin_child() noexcept {
    taking_.store(0);
    calls_.store(depth_ > 0 ? 1 : 0);
  }

 private:
  friend class WithoutLock;
  friend class WithLock;
  friend class InCall;

  static bool ends_for_this_thread() noexcept { return ends_.load() && std::this_thread::get_id() != last_; }
  [[noreturn]] static void wait_forever() noexcept {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
  /// Before the GIL is taken. After it, fetch_sub.
  static void begin_to_take() noexcept {
    taking_.fetch_add(1);
    if (!ends_for_this_thread()) return;
    taking_.fetch_sub(1);
    wait_forever();
  }

  inline static std::atomic<bool> ends_{false};
  inline static std::atomic<int> taking_{0};  ///< threads that take the GIL back now
  inline static std::atomic<int> calls_{0};   ///< threads in a call of this module, and not in WithoutLock
  inline static thread_local int depth_ = 0;  ///< calls of this module in this thread, one inside the other
  inline static std::thread::id last_{};
};

/// A call of a function of this module, from its begin to its end. The GIL is held.
class InCall {
 public:
  InCall() noexcept {
    if (EndOfProgram::depth_++ == 0) ++EndOfProgram::calls_;
  }
  InCall(const InCall&) = delete;
  ~InCall() {
    if (--EndOfProgram::depth_ == 0) --EndOfProgram::calls_;
  }
};

/// Releases the GIL until the end of the block, like nb::gil_scoped_release. At the end of the program, a thread that
/// wants the GIL back waits here forever.
class WithoutLock {
 public:
  WithoutLock() noexcept {
    if (EndOfProgram::depth_ > 0) --EndOfProgram::calls_;
    state_ = PyEval_SaveThread();
  }
  WithoutLock(const WithoutLock&) = delete;
  ~WithoutLock() {
    EndOfProgram::begin_to_take();
    PyEval_RestoreThread(state_);
    if (EndOfProgram::depth_ > 0) ++EndOfProgram::calls_;
    EndOfProgram::taking_.fetch_sub(1);
  }

 private:
  PyThreadState* state_;
};

/// Takes the GIL inside a WithoutLock block until the end of this block, with the same answer at the program's end.
class WithLock {
 public:
  WithLock() noexcept {
    EndOfProgram::begin_to_take();
    state_ = PyGILState_Ensure();
    ++EndOfProgram::calls_;
    EndOfProgram::taking_.fetch_sub(1);
  }
  WithLock(const WithLock&) = delete;
  ~WithLock() {
    --EndOfProgram::calls_;
    PyGILState_Release(state_);
  }

 private:
  PyGILState_STATE state_{};
};

}  // namespace punctura::bindings
