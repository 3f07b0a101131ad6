// Blocks of independent work on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace punctura::batch {

/// What the caller and the threads tell each other while they work. `done` counts in any unit.
struct Work {
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stop{false};
};

/// Calls block(i) once for each i < count, on `threads` threads, while `watch` is called 20 times a second on the
/// calling thread. The blocks must not depend on each other. If watch() returns false, it sets work.stop, and no
/// further block starts. watch may be empty; then the calling thread is one of the threads. Rethrows the first
/// exception of a block or of watch(), after all threads have ended.
void for_each_block(std::size_t count, std::size_t threads, Work& work, const std::function<void(std::size_t)>& block,
                    const std::function<bool()>& watch);

/// The number of threads to use if 0 are wanted: one for each processor that this process may use.
std::size_t usable_threads(std::size_t wanted) noexcept;

struct LineCode;

struct RunOptions {
  std::size_t threads = 0;         ///< 0: one for each processor
  std::size_t block = 256;         ///< trials that one thread computes together
  const LineCode* code = nullptr;  ///< null: the fastest instruction set
  /// Called 20 times a second with the finished part of all work. The run stops if it returns false. May be empty.
  std::function<bool(std::size_t, std::size_t)> watch{};
};

}  // namespace punctura::batch
