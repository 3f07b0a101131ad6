// A law of your own with memory and time, a skin that heals: tried in a batch, felt on a device, and recorded.
#include <algorithm>
#include <cstdio>
#include <future>

#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;

struct SkinLaw {
  using Scalar = double;
  struct Memory {
    double front, hole;  ///< the deepest point of this insertion, and of all, m
    double healed;       ///< how far the skin between them has healed: 0 is open, 1 is whole
  };
  double cut, friction, bottom;  // N, N, m

  PiecewiseBand<double, 5> pieces(double = 1, const Memory& m = {}) const noexcept {
    const double front = std::min(m.front, bottom), hole = std::clamp(m.hole, front, bottom);
    const auto wall = [&](double whole) { return BandPiece<double>{0, {-friction - whole * cut}, {friction}}; };
    // A piece without length is still a wall: it has the force of its neighbour.
    return {{0, front, hole, bottom}, {{{}, wall(0), wall(m.healed), wall(hole < bottom ? 1 : m.healed), wall(0)}}};
  }
  PiecewiseBand<double, 5> pieces(const Memory& m) const noexcept { return pieces(1, m); }
  bool advance(Memory& m, double depth, double dt) const noexcept {  // in each tick; dt: s
    if (depth > 0) return depth > m.front && (m.front = depth, true);
    if (m.front > 0) m = {0, std::max(m.front, m.hole), m.front < m.hole ? m.healed : 0};  // the tip has left
    m.healed += (1 - m.healed) * dt / 2;                                                   // within some 2 s
    return true;
  }
};

int main() {
  const Scene scene{"skin", {1.08e-3, 0.28}, {400, 1}, {{"skin", {570, 0.8, 0.05, 2e-3}, {0, 0, 0}, {0, -1, 0}}}};
  const auto law_of = [](const Needle&, const Membrane& m, std::size_t) {
    return SkinLaw{m.precompression, m.friction, m.thickness};
  };
  const auto twice = [](double rest) { return StrokesMotion({{0, 5e-3, 0}, {0, -9e-3, 0}, 2, 0.5, rest, 0}, 1); };

  const auto peak = [&](double rest) {  // of the second insertion
    Experiment trial(build<double>(scene, law_of), 1 / 1600.0, twice(rest), {0, -1, 0});
    double last = 0;
    for (int k = 0; k < 1600 * (2 + 5 * rest); ++k)
      if (const Snapshot& s = trial.step(); k > 1600 * (1 + 3 * rest)) last = std::max(last, s.force[1]);
    return last;
  };
  std::vector<std::pair<double, std::future<double>>> batch;
  for (double rest : {0.5, 1.0, 2.0, 4.0, 8.0}) batch.emplace_back(rest, std::async(peak, rest));
  for (auto& [rest, force] : batch) std::printf("rest %4.1f s   second peak %6.3f N\n", rest, force.get());

  LoopSettings settings;
  settings.model = StepMaker::with_laws(law_of);
  SimulatedOptions options;
  options.ticks = 9 * 1600;
  options.real_time = false;  // for hardware: open_device("openhaptics") from punctura_runtime/backends/registry.hpp
  const auto device = std::make_shared<SimulatedDevice>(twice(1), options);
  ServoLoop loop(device, scene, settings);
  SnapshotRing& ticks = loop.listen(options.ticks);
  loop.arm();
  loop.start();
  while (!device->finished()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  loop.stop();
  std::FILE* file = std::fopen("skin.csv", "w");
  std::fputs("time_s,y_m,fy_N\n", file);
  ticks.pop(options.ticks, [&](const Snapshot& s) {
    std::fprintf(file, "%.6f,%.9f,%.6f\n", s.sample.time, s.sample.position[1], s.force[1]);
  });
  std::fclose(file);
}
