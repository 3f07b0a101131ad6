// One membrane in one dimension: depth in, force out. The 0.1 mm membrane of K06 section 4 at a constant 5 mm/s.
#include <cstdio>

#include "punctura/punctura.hpp"

int main() {
  const punctura::Needle needle{1.08e-3, 0.28};  // diameter (m), tip angle (rad)
  const punctura::Membrane wall{570, 0.41, 0.2,
                                0.1e-3};      // stiffness (N/m), precompression (N), friction, thickness (m)
  const punctura::Coupling coupling{400, 1};  // stiffness (N/m), damping (N s/m)
  const double period = 1 / 1600.0;           // s

  punctura::Proxy1d proxy(punctura::ThickLaw(needle, wall), coupling, period);
  for (int k = 0; k <= 3200; ++k) {
    const double depth = -1e-3 + 5e-3 * k * period;  // m
    const double force = proxy.step(depth);          // N; negative resists insertion
    if (k % 160 == 0) std::printf("depth %6.2f mm   force %7.4f N\n", depth * 1e3, force);
  }
}
