// A law that feels time, on the simulated device.
#include <doctest/doctest.h>

#include "core/support/healing_law.hpp"
#include "core/support/paper_scene.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// The largest felt force of each of two insertions, N, with a rest between them, s.
std::array<double, 2> felt_peaks(double rest) {
  LoopSettings settings;
  settings.model = StepMaker::with_laws([](const Needle&, const Membrane&, std::size_t) { return HealingLaw{}; });
  const Strokes strokes{{0, 5e-3, 0}, {0, -9e-3, 0}, 2, 0.5, rest, 0};
  const StrokesMotion twice(strokes, 1);
  SimulatedOptions options;
  options.real_time = false;
  options.ticks = static_cast<std::uint64_t>(1600 * twice.duration());
  const auto device = std::make_shared<SimulatedDevice>(twice, options);
  ServoLoop loop(device, paper_scene(), settings);
  SnapshotRing& ticks = loop.listen(options.ticks);
  loop.run();
  std::array<double, 2> peaks{};
  ticks.pop(options.ticks, [&](const Snapshot& s) {
    CHECK(s.fault == Fault::none);
    double& peak = peaks[s.sample.time > twice.duration() / 2];
    peak = std::max(peak, s.force[1]);
  });
  return peaks;
}

}  // namespace

TEST_CASE("the hand feels that a hole heals: the second peak grows with the rest before it" *
          doctest::test_suite("numbers")) {
  double last = 0;
  for (const double rest : {0.6, 1.5, 3.0, 9.0}) {
    CAPTURE(rest);
    const auto [first, second] = felt_peaks(rest);
    CHECK(first == doctest::Approx(1.05).epsilon(0.02));
    CHECK(second > last + 0.02);
    CHECK(second < first);
    last = second;
  }
}
