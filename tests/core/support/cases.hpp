// How many random cases a test runs: PUNCTURA_CASES in the environment scales them, 1 by default.
#pragma once

#include <cstdlib>

namespace punctura::test {

inline int cases(int ordinary) {
  const char* scale = std::getenv("PUNCTURA_CASES");
  const double factor = scale ? std::atof(scale) : 1.0;
  const double n = ordinary * (factor > 0 ? factor : 1.0);
  return n < 1 ? 1 : static_cast<int>(n);
}

}  // namespace punctura::test
