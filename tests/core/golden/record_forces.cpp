// Writes golden_forces.inc. Use it only for a change that is intended to change forces:
// cmake --build --preset dev --target record_forces && build/dev/tests/core/record_forces >
// tests/core/golden/golden_forces.inc
#include <cstdio>

#include "golden_hashes.hpp"

int main() {
  using namespace punctura::test;
  for (std::size_t k = 0; k < golden_count; ++k) {
    const GoldenHashes now = golden_hashes(k);
    for (std::size_t i = 0; i < now.size(); ++i)
      std::printf("%s0x%016llx%s", i == 0 ? "{" : " ", static_cast<unsigned long long>(now[i]),
                  i == 3   ? ",\n"
                  : i == 7 ? "},\n"
                           : ",");
  }
}
