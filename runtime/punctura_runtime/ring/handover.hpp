// From one thread to one other, without a lock: a new object, or the newest value.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace punctura {

/// One thread offers, the other takes between two of its ticks. The taking thread never frees memory.
template <typename T>
class Handover {
 public:
  Handover() = default;
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  ~Handover() {
    delete offered_.load();
    delete retired_.load();
  }

  /// Offering thread. Drops an older offer that was not taken.
  void offer(std::unique_ptr<T> object) noexcept {
    collect();
    delete offered_.exchange(object.release(), std::memory_order_acq_rel);
  }
  bool pending() const noexcept { return offered_.load(std::memory_order_acquire) != nullptr; }
  /// Offering thread. Frees the retired object.
  void collect() noexcept { delete retired_.exchange(nullptr, std::memory_order_acq_rel); }

  /// Taking thread. The new object, or nullptr; after it, the caller retires its old one. Never waits: an offer stays
  /// until the last retired object has been collected.
  T* take() noexcept {
    if (retired_.load(std::memory_order_acquire) != nullptr) return nullptr;
    return offered_.exchange(nullptr, std::memory_order_acq_rel);
  }
  void retire(T* object) noexcept { retired_.store(object, std::memory_order_release); }

 private:
  std::atomic<T*> offered_{nullptr}, retired_{nullptr};
};

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
