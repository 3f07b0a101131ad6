// How a batch is computed. The results do not depend on it.
#pragma once

#include <cstddef>
#include <functional>

namespace punctura::batch {

struct LineCode;

struct RunOptions {
  std::size_t threads = 0;         ///< 0: one for each processor
  std::size_t block = 256;         ///< trials that one thread computes together
  const LineCode* code = nullptr;  ///< null: the fastest instruction set
  /// Called 20 times a second with the finished part of all work. The run stops if it returns false. May be empty.
  std::function<bool(std::size_t, std::size_t)> watch{};
};

}  // namespace punctura::batch
