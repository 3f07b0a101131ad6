// The newest value of one thread for one other thread, without a lock.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace punctura {

/// One copy is written, one is read, one is between them. Neither side ever waits or sees half a value.
template <typename T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& first = T{}) : copies_{first, first, first} {}

  /// Writer.
  template <typename Fill>
  void write(Fill&& fill) noexcept {
    fill(copies_[back_]);
    back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & index;
  }
  /// Reader. Valid until the next read.
  const T& read() noexcept {
    if (middle_.load(std::memory_order_relaxed) & fresh)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index;
    return copies_[front_];
  }

 private:
  static constexpr std::uint8_t fresh = 4, index = 3;
  std::array<T, 3> copies_;
  std::uint8_t back_ = 0, front_ = 1;
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace punctura
