// How many random cases a test runs.
#pragma once

#include <cstdlib>

namespace punctura::test {

/// As many as the test wants, or PUNCTURA_CASES of the environment: a few for the sanitizers, a million for a long night.
inline int cases(int ordinary) {
  const char* wanted = std::getenv("PUNCTURA_CASES");
  const int n = wanted ? std::atoi(wanted) : 0;
  return n > 0 ? n : ordinary;
}

}  // namespace punctura::test
