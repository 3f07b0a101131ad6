// How many random cases a test runs.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace punctura::test {

/// The number of random cases: `ordinary`, or the environment variable PUNCTURA_CASES. Use few for sanitizers and
/// many for a long run.
inline int cases(int ordinary) {
  const char* wanted = std::getenv("PUNCTURA_CASES");
  const int n = wanted ? std::atoi(wanted) : 0;
  return n > 0 ? n : ordinary;
}

/// The same, but never more than `ordinary`. Also for the size of a case.
inline int at_most(int ordinary) { return std::min(ordinary, cases(ordinary)); }

}  // namespace punctura::test
