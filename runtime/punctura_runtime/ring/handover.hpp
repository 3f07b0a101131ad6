// A whole new object for a running thread, and the old one back, without a lock.
#pragma once

#include <atomic>
#include <memory>

namespace punctura {

/// One thread offers, the other takes between two of its ticks. Nothing is ever freed on the taking side.
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

  /// Offering side. An older offer that was not taken yet is dropped.
  void offer(std::unique_ptr<T> object) noexcept {
    collect();
    delete offered_.exchange(object.release(), std::memory_order_acq_rel);
  }
  bool pending() const noexcept { return offered_.load(std::memory_order_acquire) != nullptr; }
  /// Offering side: frees what was retired.
  void collect() noexcept { delete retired_.exchange(nullptr, std::memory_order_acq_rel); }

  /// Taking side: the new object, or nullptr. The caller then retires its old one. Waits for nothing: while the last retired
  /// object has not been collected, an offer stays where it is.
  T* take() noexcept {
    if (retired_.load(std::memory_order_acquire) != nullptr) return nullptr;
    return offered_.exchange(nullptr, std::memory_order_acq_rel);
  }
  void retire(T* object) noexcept { retired_.store(object, std::memory_order_release); }

 private:
  std::atomic<T*> offered_{nullptr}, retired_{nullptr};
};

}  // namespace punctura
