// Where an insertion stores its membranes and samples: on the heap, or inside the object.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace punctura {

/// A vector that stores at most N elements inside the object.
///
/// It aborts the program if there are more than N elements: without one of its membranes, a scene would give a wrong
/// force.
template <typename T, std::size_t N>
class FixedVector {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  FixedVector() = default;
  FixedVector(std::size_t n, const T& value) {
    for (std::size_t i = 0; i < n; ++i) emplace_back(value);
  }
  void reserve(std::size_t n) const noexcept {
    if (n > N) std::abort();
  }
  template <typename... Args>
  T& emplace_back(Args&&... args) noexcept {
    reserve(size_ + 1);
    return *std::construct_at(begin() + size_++, std::forward<Args>(args)...);
  }

  std::size_t size() const noexcept { return size_; }
  T* begin() noexcept { return std::launder(reinterpret_cast<T*>(bytes_)); }
  const T* begin() const noexcept { return std::launder(reinterpret_cast<const T*>(bytes_)); }
  T* end() noexcept { return begin() + size_; }
  const T* end() const noexcept { return begin() + size_; }
  T& operator[](std::size_t i) noexcept { return begin()[i]; }
  const T& operator[](std::size_t i) const noexcept { return begin()[i]; }

 private:
  alignas(T) std::byte bytes_[N * sizeof(T)]{};
  std::size_t size_ = 0;
};

/// Storage on the heap, allocated at construction. It has no limit.
struct HeapStorage {
  template <typename T>
  using Membranes = std::vector<T>;
  template <typename T>
  using Samples = std::vector<T>;
};

/// Storage without a heap, for at most most_membranes membranes.
///
/// most_in_15_ms: how many samples conditioning and direction from motion look back at. This is the number of samples
/// in 15 ms, plus one: 25 at 1600 Hz.
template <std::size_t most_membranes, std::size_t most_in_15_ms = 25>
struct FixedStorage {
  template <typename T>
  using Membranes = FixedVector<T, most_membranes>;
  template <typename T>
  using Samples = FixedVector<T, 2 * most_in_15_ms>;  // LineFit writes each sample twice
};

}  // namespace punctura
