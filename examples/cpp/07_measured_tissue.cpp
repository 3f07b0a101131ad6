// A wall of measured tissue: a grip that grows faster than linearly, a tail, cutting, and a hole that stays.
#include <cmath>
#include <cstdio>

#include "punctura/punctura.hpp"

int main() {
  const punctura::Needle needle{1.27e-3, 0.3};
  const punctura::Membrane wall{400, 0.1, 0.2, 0.5e-3};
  punctura::Tissue tissue;  // all additions off: K06
  tissue.grip = punctura::GripShape::exponential;
  tissue.growth = 900;          // 1/m: G = c + kappa (exp(growth y) - 1) / growth
  tissue.tail_length = 0.6e-3;  // m: behind the tip the shaft's friction falls ...
  tissue.tail_floor = 0.7;      // ... to this part
  tissue.cutting = 0.3;         // N: only while the tip goes where it has not been
  tissue.set = 0.2;             // the part of the grip that a hole has lost

  punctura::Proxy1d proxy(punctura::TissueLaw(needle, wall, tissue), punctura::Coupling{4000, 1}, 1 / 1600.0);
  for (int insertion = 1; insertion <= 2; ++insertion) {
    double work = 0, before = -1e-3;
    for (int k = 0; k <= 6400; ++k) {  // in and out, 10 mm at 5 mm/s
      const double depth = 4e-3 - 5e-3 * std::cos(k * 3.141592653589793 / 3200);
      const double force = proxy.step(depth);
      if (k <= 3200) work -= force * (depth - before);
      before = depth;
      if (k % 400 == 0) std::printf("depth %6.2f mm   force %7.4f N\n", depth * 1e3, force);
    }
    std::printf("insertion %d took %.3f mJ\n", insertion, work * 1e3);
  }
}
