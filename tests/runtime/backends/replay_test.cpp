#include "punctura_runtime/backends/replay.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "core/support/paper_scene.hpp"
#include "punctura_runtime/backends/registry.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
const os::RealtimeSettings no_realtime{0, -1, false, false};
const ReplayOptions fast{false, no_realtime}, in_real_time{true, no_realtime};

DeviceInfo recorded(double rate = 1600) {
  DeviceInfo info;
  info.backend = "some";
  info.model = "Some 1";
  info.rate = rate;
  return info;
}

/// Readings on the way from 2 mm above the membrane to 3 mm below, `n` of them.
std::vector<DeviceSample> readings_of_a_stroke(std::size_t n) {
  std::vector<DeviceSample> all;
  for (std::size_t k = 0; k < n; ++k)
    all.push_back(reading(k, 2e-3 - 5e-3 * static_cast<double>(k) / static_cast<double>(n)));
  return all;
}

/// Every tick of an armed loop on a device that ends by itself.
template <typename AnyDevice>
std::vector<Snapshot> snapshots(std::shared_ptr<AnyDevice> device, const Scene& scene, std::size_t room = 1 << 13) {
  ServoLoop loop(device, scene);
  auto& ring = loop.listen(room);
  loop.arm();
  loop.start();
  while (!device->finished()) std::this_thread::yield();
  loop.stop();
  std::vector<Snapshot> all;
  ring.pop(room, [&](const Snapshot& s) { all.push_back(s); });
  REQUIRE(ring.lost() == 0);
  return all;
}

std::vector<DeviceSample> samples_of(const std::vector<Snapshot>& all) {
  std::vector<DeviceSample> samples;
  for (const Snapshot& s : all) samples.push_back(s.sample);
  return samples;
}

bool same_forces(const std::vector<Snapshot>& a, const std::vector<Snapshot>& b) {
  bool same = a.size() == b.size();
  for (std::size_t k = 0; same && k < a.size(); ++k) same = a[k].tick == b[k].tick && a[k].force == b[k].force;
  return same;
}
}  // namespace

TEST_CASE("a replay through the recorded scene gives the recorded forces, bit for bit" *
          doctest::test_suite("numbers")) {
  SimulatedOptions options;
  options.real_time = false;
  options.ticks = 5000;
  options.seed = 3;
  const Strokes strokes{{0, 5e-3, 0}, {0, -10e-3, 0}, 1, 1.0, 0.6, 0.0};
  auto simulated = std::make_shared<SimulatedDevice>(StrokesMotion(strokes, 3), options);
  const auto first = snapshots(simulated, paper_scene(1e-4));
  auto replay = std::make_shared<ReplayDevice>(samples_of(first), simulated->info(), fast);
  CHECK(same_forces(first, snapshots(replay, paper_scene(1e-4))));
  CHECK_FALSE(same_forces(
      first, snapshots(std::make_shared<ReplayDevice>(samples_of(first), simulated->info(), fast), paper_scene(1e-3))));
}

TEST_CASE("in real time, the replay skips no sample and keeps the recorded times") {
  const auto samples = readings_of_a_stroke(200);
  auto device = std::make_shared<ReplayDevice>(samples, recorded(8000), in_real_time);
  const std::int64_t begin = os::now_ns();
  const auto all = snapshots(device, paper_scene());
  CHECK(os::now_ns() - begin >= 200 * 125'000);
  REQUIRE(all.size() == samples.size());
  bool same = true;
  for (std::size_t k = 0; k < all.size(); ++k)
    same = same && all[k].sample.sequence == samples[k].sequence && all[k].sample.time == samples[k].time &&
           all[k].sample.position == samples[k].position;
  CHECK(same);
}

TEST_CASE("a stopped replay has not ended, and starts again from the beginning") {
  auto device = std::make_shared<ReplayDevice>(readings_of_a_stroke(100'000), recorded(), in_real_time);
  ServoLoop loop(device, paper_scene());
  loop.start();
  while (loop.report().ticks < 5) std::this_thread::yield();
  loop.stop();
  const auto ticks = loop.report().ticks;
  CHECK_FALSE(device->finished());
  CHECK(loop.report().ticks == ticks);
  loop.stop();  // a second stop is harmless
  loop.reset();
  loop.start();
  while (loop.report().ticks == ticks) std::this_thread::yield();
  loop.stop();
  CHECK(loop.latest().sample.sequence < loop.report().ticks - ticks);
  CHECK(loop.latest().fault == Fault::none);
}

TEST_CASE("the replay's gate finds the recorded device's faults again, also a gap in time") {
  auto samples = readings_of_a_stroke(100);
  samples[50].healthy = false;
  auto device = std::make_shared<ReplayDevice>(samples, recorded(), fast);
  CHECK(device->trouble().empty());
  const auto all = snapshots(device, paper_scene());
  CHECK(all[49].fault == Fault::none);
  CHECK(all[50].fault == Fault::device);
  CHECK(device->trouble() == "the recorded device reported a fault of its own here");

  samples = readings_of_a_stroke(100);
  for (std::size_t k = 50; k < samples.size(); ++k) samples[k].time += 0.1;
  CHECK(snapshots(std::make_shared<ReplayDevice>(samples, recorded(), fast), paper_scene())[50].fault ==
        Fault::missed_deadline);
}

TEST_CASE("a replay has the properties of the recorded device, but another name") {
  auto info = recorded();
  info.max_force = 1.5;
  info.encoder_step = 2e-5;
  info.has_orientation = true;
  const ReplayDevice device(readings_of_a_stroke(1), info, fast);
  CHECK(device.info().backend == "replay");
  CHECK(device.info().model == "Some 1, recorded");
  CHECK(device.info().max_force == 1.5);
  CHECK(device.info().encoder_step == 2e-5);
  CHECK(device.info().has_orientation);
  CHECK(ReplayDevice({}, device.info(), fast).info().model == "Some 1, recorded");  // the replay of a recorded replay
}

TEST_CASE("a recording without a rate is refused; a recording without ticks ends at once") {
  CHECK_THROWS_AS(ReplayDevice({}, recorded(not_given)), DeviceError);
  CHECK_THROWS_AS(ReplayDevice({}, recorded(0)), DeviceError);
  CHECK(
      snapshots(std::make_shared<ReplayDevice>(std::vector<DeviceSample>{}, recorded(), fast), paper_scene()).empty());
}

TEST_CASE("the registry lists replay, never chooses it by default, and explains how to name a recording") {
  for (const auto& status : enumerate_devices()) {
    if (status.backend != "replay") continue;
    CHECK(status.state == BackendStatus::State::no_device);
    CHECK(status.detail.find("replay:FILE.parquet") != std::string::npos);
  }
  CHECK_THROWS_WITH_AS(open_device("replay"), doctest::Contains("replay_device(FILE)"), DeviceError);
}
