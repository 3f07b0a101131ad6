// A law of your own with memory and time, a skin that heals: tried on all processors, felt on a device, recorded.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <vector>

#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;

struct SkinLaw {
  using Scalar = double;
  struct Memory {
    double front, hole, healed;  ///< deepest points of this insertion and of all, m; 0: open, 1: whole between them
  };
  double bottom, cut = 0.8, friction = 0.05;  // m, N, N

  PiecewiseBand<double, 5> pieces(double, const Memory& m) const noexcept {
    const double front = std::min(m.front, bottom), hole = std::clamp(m.hole, front, bottom);
    const auto wall = [&](double whole) { return BandPiece<double>{0, {-friction - whole * cut}, {friction}}; };
    // A piece without length is still a wall: it has the force of its neighbour.
    return {{0, front, hole, bottom}, {{{}, wall(0), wall(m.healed), wall(hole < bottom ? 1 : m.healed), wall(0)}}};
  }
  bool advance(Memory& m, double depth, double dt) const noexcept {  // in each tick; dt: s
    if (depth > 0) return depth > m.front && (m.front = depth, true);
    if (m.front > 0) m = {0, std::max(m.front, m.hole), m.front < m.hole ? m.healed : 0};  // the tip has left
    return m.healed += (1 - m.healed) * dt / 2, true;                                      // within some 2 s
  }
};

int main() {
  const Scene scene{"skin", {1.08e-3, 0.28}, {400, 1}, {{"skin", {570, 0.8, 0.05, 2e-3}, {0, 0, 0}, {0, -1, 0}}}};
  const auto law_of = [](Needle, Membrane m, auto) { return SkinLaw{m.thickness}; };
  const auto twice = [](double rest) { return StrokesMotion({{0, 5e-3, 0}, {0, -9e-3, 0}, 2, 0.5, rest, 0}, 1); };
  const std::vector rests{0.5, 1.0, 2.0, 4.0, 8.0};  // s
  std::vector peaks(rests.size(), 0.0);              // N, of the second insertion
  std::vector faults(rests.size(), Fault::none);
  batch::Work work;
  const auto trial = [&](std::size_t i) {
    Experiment hand(build<double>(scene, law_of), 1 / 1600.0, twice(rests[i]), {0, -1, 0});
    for (int k = 0; k < 1600 * (2 + 5 * rests[i]); ++k)
      if (const Snapshot& s = hand.step(); (faults[i] = s.fault) == Fault::none && k > 1600 * (1 + 3 * rests[i]))
        peaks[i] = std::max(peaks[i], s.force[1]);
  };
  batch::for_each_block(rests.size(), batch::usable_threads(0), work, trial, {});
  for (std::size_t i = 0; i < rests.size(); ++i) std::printf("rest %3.1f s  second peak %.3f N\n", rests[i], peaks[i]);
  // On hardware: open_device("openhaptics"), from punctura_runtime/backends/registry.hpp, and loop.run(30).
  const auto device = std::make_shared<SimulatedDevice>(twice(1), SimulatedOptions{.real_time = false, .ticks = 14400});
  ServoLoop loop(device, scene, {.model = StepMaker::with_laws(law_of)});
  SnapshotRing& ticks = loop.listen(14400);
  loop.run();
  std::ofstream file("skin.csv");
  file << "time_s,y_m,fy_N\n";
  ticks.pop(14400, [&](auto& s) { file << s.sample.time << ',' << s.sample.position[1] << ',' << s.force[1] << '\n'; });
  const Fault fault = std::max(*std::ranges::max_element(faults), loop.latest().fault);
  return fault == Fault::none ? 0 : (std::puts(describe(fault)), 1);
}
