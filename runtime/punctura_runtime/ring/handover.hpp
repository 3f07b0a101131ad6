// Replaces an object of a running thread, without a lock.
#pragma once

#include <atomic>
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

}  // namespace punctura
