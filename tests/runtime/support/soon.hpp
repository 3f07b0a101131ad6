// Waits for another thread, on a computer that may be busy, and ends if that thread hangs.
#pragma once

#include <chrono>
#include <thread>

namespace punctura::test {

/// False after a minute.
template <typename Condition>
bool soon(Condition&& condition) {
  for (int i = 0; i < 60'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace punctura::test
