// The back-ends of an installed Punctura: at least the simulated device is there.
#include <punctura_runtime/backends/registry.hpp>

#include <cstdio>

int main() {
  bool simulated = false;
  for (const auto& status : punctura::enumerate_devices()) {
    std::printf("%s\n", status.backend.c_str());
    simulated = simulated || status.backend == "simulated";
  }
  return simulated ? 0 : 1;
}
