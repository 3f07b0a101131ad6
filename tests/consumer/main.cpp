// A needle at 5 mm/s through one membrane, with an installed Punctura: the force has the model's peak and its plateau.
#include <punctura/model/thick_law.hpp>
#include <punctura/proxy/proxy_1d.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() {
  const punctura::Needle needle{1.08e-3, 0.28};
  const punctura::Membrane membrane{570, 0.41, 0.2, 1e-3};
  punctura::Proxy1d proxy(punctura::ThickLaw(needle, membrane), punctura::Coupling{400, 1}, 1 / 1600.0);

  double peak = 0, force = 0;
  for (int tick = 0; tick < 3200; ++tick) {
    force = proxy.step(5e-3 * tick / 1600.0);
    peak = std::min(peak, force);
  }
  std::printf("peak %.4f N, plateau %.4f N\n", peak, force);
  return std::abs(force + 0.41024) < 1e-9 && peak < -0.6 && peak > -0.74 ? 0 : 1;
}
