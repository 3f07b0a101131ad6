// A tick that gives 1 N upwards, and whose call number `at` does not return before `returns`.
#pragma once

#include <atomic>
#include <thread>

#include "punctura/device/device.hpp"

namespace punctura::test {

struct HangingTick {
  explicit HangingTick(int first_to_hang) : at(first_to_hang) {}
  Tick tick() {
    return {[](void* to, const DeviceSample&) noexcept {
              auto& own = *static_cast<HangingTick*>(to);
              for (++own.calls; own.calls == own.at && !own.returns;) std::this_thread::yield();
              return Tick::Force{0, 1, 0};
            },
            this, 5};
  }
  bool inside() const noexcept { return calls == at && !returns; }

  const int at;
  std::atomic<int> calls{0};
  std::atomic<bool> returns{false};
};

}  // namespace punctura::test
