// How many vector operations a tick takes.
#pragma once

#include "work.hpp"

namespace punctura::bench_batch {

/// The operations in one tick of a vector, which are those of one trial: the mean over all ticks of `work`.
///
/// They are those of the source. The compiler may leave out some whose result nobody reads. Lanes that leave their
/// piece of the law are computed one at a time, and that work is not counted.
struct Operations {
  double multiply = 0, add = 0, divide = 0, root = 0, min_max = 0, compare = 0, select = 0;

  double all() const noexcept { return multiply + add + divide + root + min_max + compare + select; }
};
Operations operations(Work& work, Solver solver);

}  // namespace punctura::bench_batch
