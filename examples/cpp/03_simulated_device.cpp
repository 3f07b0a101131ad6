// The whole tick on a simulated PHANTOM Omni in a simulated hand: input gate, conditioning, model, force limits.
#include <cstdio>

#include "punctura/punctura.hpp"

int main() {
  using namespace punctura;
  const Scene scene{"one wall", {1.08e-3, 0.28},  {400, 1}, {{"wall", {570, 0.41, 0.2, 0.1e-3}, {0, 0, 0}, {0, -1, 0}}},
                    {},         Direction::stylus};

  StrokesMotion strokes({{0, 5e-3, 0}, {0, -10e-3, 0}}, /*seed*/ 1);
  const int ticks = static_cast<int>(strokes.duration() * scene.servo.rate);
  Experiment experiment(scene, std::move(strokes), Vector3d(0, -1, 0));
  for (int k = 0; k < ticks; ++k) {
    const Snapshot& s = experiment.step();
    if (s.fault != Fault::none) {
      std::fprintf(stderr, "%s\n", describe(s.fault));
      return 1;
    }
    if (k % 800 == 0)
      std::printf("t %5.2f s   y %6.2f mm   force %6.3f N\n", s.sample.time, s.sample.position[1] * 1e3, s.force[1]);
  }
}
