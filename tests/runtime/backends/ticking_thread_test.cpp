#include "punctura_runtime/backends/ticking_thread.hpp"

#include <doctest/doctest.h>

using namespace punctura;

namespace {

/// Runs until it is stopped.
auto until_stopped(const TickingThread& thread) {
  return [&thread] {
    while (!thread.stopping()) std::this_thread::yield();
  };
}

}  // namespace

TEST_CASE("start returns after the preparation, at every start") {
  TickingThread thread;
  for (int i = 0; i < 2000; ++i) {
    std::atomic<bool> prepared{false};
    CHECK(thread.start({}, until_stopped(thread), [&] { return prepared = true; }));
    CHECK(prepared);
    thread.stop();
  }
}

TEST_CASE("a failed preparation ends the thread before its ticks, and it can start again") {
  TickingThread thread;
  bool ran = false;
  CHECK_FALSE(thread.start({}, [&] { ran = true; }, [] { return false; }));
  CHECK_FALSE(ran);
  CHECK(thread.start({}, [&] { ran = true; }));
  thread.stop();
  CHECK(ran);
}

TEST_CASE("a thread whose work has ended counts as running until stop(); a second stop has no effect") {
  TickingThread thread;
  CHECK(thread.start({}, [] {}));
  CHECK_THROWS_AS(thread.start({}, [] {}), DeviceError);
  thread.stop();
  thread.stop();
  CHECK_NOTHROW(thread.refuse_second_loop());
}

TEST_CASE("the thread itself requests real-time scheduling, before the preparation") {
  TickingThread thread;
  os::RealtimeSettings nothing_but_priority{80, -1, false, false};
  std::size_t known = 0;
  CHECK(thread.start(nothing_but_priority, [] {}, [&] { return (known = thread.realtime().size()) > 0; }));
  thread.stop();
  CHECK(known == thread.realtime().size());
}
