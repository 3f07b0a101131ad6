// Periodic wake-ups at absolute times, for devices without a clock of their own.
#pragma once

#include <cstdint>

#include "punctura_runtime/os/os.hpp"

namespace punctura {

/// The clock of the ticks. Tests replace it.
struct LoopClock {
  std::int64_t (*now)() noexcept = os::now_ns;
  void (*sleep_until)(std::int64_t) noexcept = os::sleep_until_ns;
};

/// Wakes at start, start + T, start + 2T, ... A late tick does not shift the later ones. Ticks whose whole period has
/// passed are skipped and counted; there is no burst to catch up.
template <typename Clock = LoopClock>
class Pacer {
 public:
  Pacer(double rate_hz, Clock clock = {}) noexcept : clock_(clock), rate_(rate_hz), start_(clock_.now()) {}

  /// Sleeps until the next tick is due. Returns the number of ticks skipped before it.
  std::uint64_t wait() noexcept {
    ++count_;
    std::uint64_t missed = 0;
    const std::int64_t now = clock_.now();
    if (due(count_ + 1) <= now) {  // the tick after this one is due, too
      const auto behind = static_cast<std::uint64_t>(static_cast<double>(now - start_) * 1e-9 * rate_);
      missed = behind > count_ ? behind - count_ : 0;
      count_ += missed;
    }
    if (due(count_) > now) clock_.sleep_until(due(count_));
    return missed;
  }

  double rate() const noexcept { return rate_; }  ///< Hz
  /// The time at which the current tick was due, ns.
  std::int64_t due() const noexcept { return due(count_); }

 private:
  std::int64_t due(std::uint64_t tick) const noexcept {
    return start_ + static_cast<std::int64_t>(static_cast<double>(tick) * 1e9 / rate_);
  }

  Clock clock_;
  double rate_;
  std::int64_t start_;
  std::uint64_t count_ = 0;
};

}  // namespace punctura
