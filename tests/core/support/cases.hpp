// How many random cases a test runs.
#pragma once

#include <cstdlib>

namespace punctura::test {

/// The number of random cases: `ordinary`, or the environment variable PUNCTURA_CASES. Use few for sanitizers and
/// many for a long run.
inline int cases(int ordinary) {
  const char* wanted = std::getenv("PUNCTURA_CASES");
  const int n = wanted ? std::atoi(wanted) : 0;
  return n > 0 ? n : ordinary;
}

}  // namespace punctura::test
