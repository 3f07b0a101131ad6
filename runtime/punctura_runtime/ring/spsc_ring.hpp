// Records from one thread to one other, without a lock.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace punctura {

/// A ring between one writer and one reader. The writer never waits: a record that finds no room is lost, and counted.
template <typename Record>
class SpscRing {
 public:
  /// Room for at least `capacity` records.
  explicit SpscRing(std::size_t capacity) : slots_(round_up(capacity)), mask_(slots_.size() - 1) {}

  /// Writer. `fill(record)` writes in place. False: there was no room.
  template <typename Fill>
  bool push(Fill&& fill) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) > mask_) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    fill(slots_[head & mask_]);
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Reader. Hands at most `limit` records, oldest first, to `take(record)`. How many there were.
  template <typename Take>
  std::size_t pop(std::size_t limit, Take&& take) {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    const std::uint64_t ready = head_.load(std::memory_order_acquire) - tail;
    const std::size_t n = ready < limit ? static_cast<std::size_t>(ready) : limit;
    for (std::size_t i = 0; i < n; ++i) take(slots_[(tail + i) & mask_]);
    tail_.store(tail + n, std::memory_order_release);
    return n;
  }

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }
  std::uint64_t written() const noexcept { return head_.load(std::memory_order_acquire); }
  std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  static std::size_t round_up(std::size_t n) {
    std::size_t power = 1;
    while (power < n) power *= 2;
    return power;
  }

  std::vector<Record> slots_;
  std::size_t mask_;
  // Each on a cache line of its own, so that the two threads do not take it from each other.
  alignas(64) std::atomic<std::uint64_t> head_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  alignas(64) std::atomic<std::uint64_t> lost_{0};
};

}  // namespace punctura
