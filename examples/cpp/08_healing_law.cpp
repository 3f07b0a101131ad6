// A law of your own with memory and time, a skin that heals: tried in a batch, felt on a device, and recorded.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <future>
#include <map>

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
  bool advance(Memory& m, double depth, double dt) const noexcept {  // in each tick; dt: s
    if (depth > 0) return depth > m.front && (m.front = depth, true);
    if (m.front > 0) m = {0, std::max(m.front, m.hole), m.front < m.hole ? m.healed : 0};  // the tip has left
    m.healed += (1 - m.healed) * dt / 2;                                                   // within some 2 s
    return true;
  }
};

int main() {
  const Scene scene{"skin", {1.08e-3, 0.28}, {400, 1}, {{"skin", {570, 0.8, 0.05, 2e-3}, {0, 0, 0}, {0, -1, 0}}}};
  const auto law_of = [](Needle, Membrane m, auto) { return SkinLaw{m.precompression, m.friction, m.thickness}; };
  const auto twice = [](double rest) { return StrokesMotion({{0, 5e-3, 0}, {0, -9e-3, 0}, 2, 0.5, rest, 0}, 1); };

  std::map<double, std::future<double>> peaks;  // N, of the second insertion, after a rest of so many s
  for (double rest : {0.5, 1.0, 2.0, 4.0, 8.0})
    peaks[rest] = std::async([&, rest] {
      Experiment trial(build<double>(scene, law_of), 1 / 1600.0, twice(rest), {0, -1, 0});
      double peak = 0;
      for (int k = 0; k < 1600 * (2 + 5 * rest); ++k)
        if (const Snapshot& s = trial.step(); k > 1600 * (1 + 3 * rest)) peak = std::max(peak, s.force[1]);
      return peak;
    });
  for (auto& [rest, peak] : peaks) std::printf("rest %4.1f s   second peak %6.3f N\n", rest, peak.get());

  // On hardware: open_device("openhaptics"), from punctura_runtime/backends/registry.hpp, and loop.run(30).
  const auto device = std::make_shared<SimulatedDevice>(twice(1), SimulatedOptions{.real_time = false, .ticks = 14400});
  ServoLoop loop(device, scene, {.model = StepMaker::with_laws(law_of)});
  SnapshotRing& ticks = loop.listen(14400);
  loop.run();
  std::ofstream file("skin.csv");
  file << "time_s,y_m,fy_N\n";
  ticks.pop(14400, [&](auto& s) { file << s.sample.time << ',' << s.sample.position[1] << ',' << s.force[1] << '\n'; });
}
