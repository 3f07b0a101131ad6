// How many random cases a test takes.
#pragma once

#include <algorithm>
#include <cstdlib>

/// As many as the test wants, or at most PUNCTURA_CASES of the environment: the sanitizers are slow, and see as much in a few.
inline int cases(int wanted) {
  const char* most = std::getenv("PUNCTURA_CASES");
  return most ? std::min(wanted, std::max(1, std::atoi(most))) : wanted;
}
