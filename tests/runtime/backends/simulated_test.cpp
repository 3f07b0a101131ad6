#include "punctura_runtime/backends/simulated.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "core/support/paper_scene.hpp"
#include "core/support/tick.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
const Strokes strokes{{0, 5e-3, 0}, {0, -10e-3, 0}, 1, 1.0, 0.6, 0.0};

void until_finished(SimulatedDevice& device) {
  while (!device.finished()) std::this_thread::yield();
}
}  // namespace

TEST_CASE("run as fast as possible, the loop on the simulated device equals the offline experiment, bit for bit") {
  const std::uint64_t ticks = 5000;
  SimulatedOptions options;
  options.real_time = false;
  options.ticks = ticks;
  options.seed = 7;
  auto made = std::make_unique<SimulatedDevice>(StrokesMotion(strokes, 7), options);
  auto& device = *made;
  ServoLoop loop(std::move(made), paper_scene(1e-4));
  auto& ring = loop.listen(8192);
  loop.arm();
  loop.start();
  until_finished(device);
  loop.stop();

  Experiment experiment(paper_scene(1e-4), StrokesMotion(strokes, 7), Vector3d(0, -1, 0), {}, {}, 7);
  bool same = true;
  std::uint64_t n = 0;
  ring.pop(ticks, [&](const Snapshot& live) {
    const Snapshot& offline = experiment.step();
    same = same && live.force == offline.force && live.sample.position == offline.sample.position && live.tick == n++;
  });
  CHECK(n == ticks);
  CHECK(same);
  CHECK(ring.lost() == 0);
}

TEST_CASE("in a second run of a device the hand makes its strokes again") {
  SimulatedOptions options;
  options.real_time = false;
  options.ticks = 5120;
  auto made = std::make_unique<SimulatedDevice>(StrokesMotion(strokes, 7), options);
  auto& device = *made;
  ServoLoop loop(std::move(made), paper_scene());
  auto& ring = loop.listen(2 * options.ticks);
  for (int run = 0; run < 2; ++run) {
    loop.arm();
    loop.start();
    until_finished(device);
    loop.stop();
    double deepest = 0, last = 0;
    ring.pop(options.ticks, [&](const Snapshot& tick) {
      CHECK(tick.fault == Fault::none);
      deepest = std::min(deepest, last = tick.sample.position[1]);
    });
    CHECK(deepest < -8e-3);
    CHECK(last > 3e-3);
  }
}

TEST_CASE("stop leaves zero force on the plant, and no tick follows") {
  SimulatedOptions options;
  options.realtime = {0, -1, false, false};
  auto made = std::make_unique<SimulatedDevice>(Target({0, -2e-3, 0}), options);
  auto& device = *made;
  ServoLoop loop(std::move(made), paper_scene());
  loop.start();
  while (loop.report().ticks < 20) std::this_thread::yield();
  loop.stop();
  const auto ticks = loop.report().ticks;
  CHECK(device.last_force() == zero);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK(loop.report().ticks == ticks);
  loop.stop();  // a second stop is harmless
}

TEST_CASE("an invalid reading ends the plant's force in the same tick, until a reset") {
  SimulatedOptions options;
  options.real_time = false;
  auto made = std::make_unique<SimulatedDevice>(Target({0, 2e-3, 0}), options);
  auto& device = *made;
  ServoLoop loop(std::move(made), paper_scene());
  loop.arm();
  loop.start();
  while (loop.report().ticks < 2000) std::this_thread::yield();
  device.move_to({0, -4e-3, 0});
  while (loop.latest().force[1] < 0.3) std::this_thread::yield();
  device.spoil([](DeviceSample& s) { s.position[0] = std::numeric_limits<double>::quiet_NaN(); });
  while (loop.latest().fault == Fault::none) std::this_thread::yield();
  CHECK(loop.latest().force == zero);
  const auto then = loop.report().ticks;
  while (loop.report().ticks < then + 2000) std::this_thread::yield();
  CHECK(loop.latest().force == zero);
  CHECK(loop.fault_history().size() == 1000);
  loop.stop();
}

TEST_CASE("direction and button of the stylus can be set during a run") {
  SimulatedOptions options;
  options.real_time = false;
  auto made = std::make_unique<SimulatedDevice>(Target({0, 2e-3, 0}), options);
  auto& device = *made;
  LoopSettings settings;
  settings.gate.dead_man = 1;
  ServoLoop loop(std::move(made), paper_scene(), settings);
  loop.arm();
  loop.start();
  while (loop.report().ticks < 100) std::this_thread::yield();
  CHECK(loop.latest().state == ServoState::waiting);  // the button is not held
  device.point({0.6, -0.8, 0}, 1);
  while (loop.latest().state != ServoState::active) std::this_thread::yield();
  CHECK(loop.latest().sample.axis == std::array<double, 3>{0.6, -0.8, 0});
  device.point({0.6, -0.8, 0}, 0);
  while (loop.latest().state == ServoState::active) std::this_thread::yield();
  CHECK(loop.latest().force == zero);
  loop.stop();
}
