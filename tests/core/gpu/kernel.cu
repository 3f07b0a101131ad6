// The core in kernels, each thread with a proxy of its own: K06's law and both solvers, and measured tissue between gate
// and limiter. tools/small_targets.sh compiles them; nothing runs them.
#include "punctura/model/thick_law.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/proxy/relaxing_coupling.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"

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

/// A needle in measured tissue, behind its guards. The host makes it: the constructor of a TissueLaw reads a table.
struct Guarded {
  InputGate gate;
  Proxy3d<TissueLaw, RelaxingCoupling<double>> proxy;
  ForceLimiter limiter;
};

/// sample, force: (ticks, trials).
__global__ void guarded(const Guarded* untouched, const DeviceSample* sample, Vector3d* force, int trials, int ticks) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i >= trials) return;
  Guarded own = *untouched;
  for (int k = 0; k < ticks; ++k) {
    const DeviceSample& s = sample[k * trials + i];
    if (own.gate.step(s) != Fault::none) return;
    force[k * trials + i] = own.limiter.step(own.proxy.step(to_vector(s.position), to_vector(s.axis)));
  }
}
