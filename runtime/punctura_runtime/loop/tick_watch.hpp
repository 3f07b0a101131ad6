// Finds that the ticks of a device have ceased. The device then holds its last force.
#pragma once

#include <algorithm>
#include <cstdint>

#include "punctura/device/device.hpp"

namespace punctura {

class TickWatch {
 public:
  /// ticks: before the device was started. now: once it has started, ns.
  void begin(std::uint64_t ticks, std::int64_t now) noexcept {
    first_ = ticks_ = ticks;
    since_ = now;
  }

  /// Seconds without a tick, if the device may not be silent for so long; otherwise 0. deadline: of the gate, s.
  double silent(std::uint64_t ticks, std::int64_t now, const LongestSilence& longest, double deadline) noexcept {
    if (ticks != ticks_) since_ = now;
    ticks_ = ticks;
    const double passed = static_cast<double>(now - since_) * 1e-9;
    const double most = std::max(ticks == first_ ? longest.at_start : longest.later, 5 * deadline);
    return passed < most ? 0 : passed;
  }

 private:
  std::uint64_t first_ = 0, ticks_ = 0;
  std::int64_t since_ = 0;
};

}  // namespace punctura
