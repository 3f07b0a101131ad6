// A device whose stop() does not return before it is released.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "punctura_runtime/backends/fed.hpp"

namespace punctura::test {

struct StuckInStop : FedDevice {
  using FedDevice::FedDevice;
  ~StuckInStop() override { released = true; }
  void stop() noexcept override {
    while (!released) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    FedDevice::stop();
  }
  std::atomic<bool> released{false};
};

}  // namespace punctura::test
