// The thread of a device that Punctura paces.
#pragma once

#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "punctura/device/device.hpp"

namespace punctura {

/// Throws DeviceError where a device is asked to tick for a second loop: the first would be left without ticks and not know.
inline void refuse_second_loop(bool ticks_already) {
  if (ticks_already) throw DeviceError("the device runs in another loop already: stop that one first");
}

/// Throws DeviceError where the system has no thread to give.
template <typename Run>
std::thread ticking_thread(Run run) {
  try {
    return std::thread(std::move(run));
  } catch (const std::system_error& error) {
    throw DeviceError(std::string("no thread for the device's ticks: ") + error.what());
  }
}

}  // namespace punctura
