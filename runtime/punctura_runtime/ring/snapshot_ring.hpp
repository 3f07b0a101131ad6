// A queue of snapshots from the tick to one other thread, without a lock.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "punctura/servo/snapshot.hpp"

namespace punctura {

/// The size of a snapshot with that many membranes, bytes. Unused membranes are at its end.
constexpr std::size_t used_bytes(std::size_t membranes) noexcept {
  return offsetof(Snapshot, membranes) + membranes * sizeof(MembraneRecord);
}

/// A ring between one writer and one reader. The writer never waits: if the ring is full, the snapshot is lost and
/// counted.
///
/// Snapshots are stored without their unused membranes: in full length, a few seconds would take 100 MB, and each tick
/// would touch pages that are in no cache.
class SnapshotRing {
 public:
  /// The largest ring, whatever the number of membranes and the rate.
  static constexpr std::size_t most_bytes = std::size_t{32} << 20;

  /// The number of snapshots with that many membranes in the largest ring.
  static constexpr std::size_t most_snapshots(std::size_t membranes) noexcept {
    return most_bytes / used_bytes(membranes);
  }

  /// Room for `capacity` snapshots with that many membranes, but at most most_bytes. At least two of the longest
  /// snapshots fit, so that one always fits after a skipped end of the ring.
  SnapshotRing(std::size_t capacity, std::size_t membranes)
      : capacity_(std::min(capacity, most_snapshots(membranes))),
        words_(std::max(capacity_ * words(membranes), 2 * words(max_membranes))) {}

  /// Writer. False if the ring is full.
  bool push(const Snapshot& snapshot) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::size_t at = head % words_.size(), to_end = words_.size() - at, length = words(snapshot.membrane_count);
    const std::size_t skipped = length > to_end ? to_end : 0;  // a snapshot is stored in one piece
    if (head + skipped + length - tail_.load(std::memory_order_acquire) > words_.size()) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    if (skipped > 0) words_[at] = nothing;
    std::memcpy(&words_[skipped > 0 ? 0 : at], &snapshot, used_bytes(snapshot.membrane_count));
    head_.store(head + skipped + length, std::memory_order_release);
    return true;
  }

  /// Reader. Passes at most `limit` snapshots, oldest first, to `take(snapshot)`. Returns their number.
  template <typename Take>
  std::size_t pop(std::size_t limit, Take&& take) {
    std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    const std::uint64_t head = head_.load(std::memory_order_acquire);
    std::size_t n = 0;
    while (n < limit && tail < head) {
      const std::size_t at = tail % words_.size();
      if (words_[at] == nothing) {
        tail += words_.size() - at;
        continue;
      }
      std::memcpy(static_cast<void*>(&read_), &words_[at], used_bytes(0));
      std::memcpy(static_cast<void*>(&read_), &words_[at], used_bytes(read_.membrane_count));
      take(static_cast<const Snapshot&>(read_));
      tail += words(read_.membrane_count);
      ++n;
    }
    tail_.store(tail, std::memory_order_release);
    return n;
  }

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }
  std::size_t capacity() const noexcept { return capacity_; }

 private:
  using Word = std::uint64_t;
  static constexpr Word nothing = ~Word{0};  ///< instead of a tick: the next snapshot is at the start of the ring
  static_assert(offsetof(Snapshot, tick) == 0 && sizeof(Snapshot::tick) == sizeof(Word));

  static constexpr std::size_t words(std::size_t membranes) noexcept { return used_bytes(membranes) / sizeof(Word); }
  static_assert(used_bytes(0) % sizeof(Word) == 0 && sizeof(MembraneRecord) % sizeof(Word) == 0);

  std::size_t capacity_;
  std::vector<Word> words_;
  Snapshot read_{};  ///< used by the reader
  // Words written and read in total. Each has its own cache line, so that the two threads do not contend for one.
  alignas(64) std::atomic<std::uint64_t> head_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  alignas(64) std::atomic<std::uint64_t> lost_{0};
};

}  // namespace punctura
