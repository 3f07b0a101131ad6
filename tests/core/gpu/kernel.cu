// The core in a kernel: K06's law and both solvers, each thread with a proxy of its own. tools/small_targets.sh compiles
// it; nothing runs it.
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"

using namespace punctura;

/// depth, force: (ticks, trials). friction: of each trial's membrane.
__global__ void on_a_line(const double* depth, const double* friction, double* force, int trials, int ticks,
                          Solver solver) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i >= trials) return;
  const ThickLaw law(Needle{1.08e-3, 0.28}, Membrane{570, 0.41, friction[i], 1e-4});
  Proxy1d<ThickLaw> proxy(law, Coupling{400, 1}, 1 / 1600.0, solver);
  for (int k = 0; k < ticks; ++k) force[k * trials + i] = proxy.step(depth[k * trials + i]);
}

/// position, force: (ticks, trials) vectors.
__global__ void in_space(const Vector3d* position, Vector3d* force, int trials, int ticks, Solver solver) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i >= trials) return;
  const ThickLaw law(Needle{1.08e-3, 0.28}, Membrane{570, 0.41, 0.2, 1e-4});
  Proxy3d<ThickLaw> proxy(law, {0, 0, 0}, {0, -1, 0}, Coupling{400, 1}, 1 / 1600.0, solver);
  for (int k = 0; k < ticks; ++k) force[k * trials + i] = proxy.step(position[k * trials + i], {0, -1, 0});
}
