// Durations in a running loop.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>

namespace punctura {

/// Counts of durations, ns, in bins of 1/8 octave: accurate to 13 % from 1 ns to 18 s.
///
/// One thread adds; others may read at the same time.
class Histogram {
 public:
  static constexpr std::size_t bins = 34 * 8;
  using Counts = std::array<std::uint64_t, bins>;

  void add(std::int64_t ns) noexcept {
    const std::uint64_t v = ns > 0 ? static_cast<std::uint64_t>(ns) : 0;
    auto& count = counts_[bin(v)];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (v > largest_.load(std::memory_order_relaxed)) largest_.store(v, std::memory_order_relaxed);
  }

  Counts counts() const noexcept {
    Counts copy;
    for (std::size_t i = 0; i < bins; ++i) copy[i] = counts_[i].load(std::memory_order_relaxed);
    return copy;
  }
  std::uint64_t largest_ns() const noexcept { return largest_.load(std::memory_order_relaxed); }

  /// The bin of a duration: one for each value below 8, then eight for each octave.
  static constexpr std::size_t bin(std::uint64_t v) noexcept {
    if (v < 8) return static_cast<std::size_t>(v);
    const unsigned octave = static_cast<unsigned>(std::bit_width(v)) - 4;  // 0 for 8..15
    const std::size_t at = 8 + octave * 8 + static_cast<std::size_t>((v >> octave) - 8);
    return at < bins ? at : bins - 1;
  }
  /// The smallest duration in a bin, ns.
  static constexpr std::uint64_t edge(std::size_t at) noexcept {
    if (at < 8) return at;
    return (std::uint64_t{8} + (at - 8) % 8) << ((at - 8) / 8);
  }
  /// The duration that a share of all does not exceed (a quantile), ns; the upper edge of its bin.
  static std::uint64_t quantile(const Counts& counts, double share) noexcept {
    std::uint64_t total = 0, seen = 0;
    for (auto count : counts) total += count;
    for (std::size_t i = 0; i < bins; ++i) {
      seen += counts[i];
      if (static_cast<double>(seen) >= share * static_cast<double>(total) && seen > 0) return edge(i + 1);
    }
    return 0;
  }

 private:
  std::array<std::atomic<std::uint64_t>, bins> counts_{};
  std::atomic<std::uint64_t> largest_{0};
};

}  // namespace punctura
