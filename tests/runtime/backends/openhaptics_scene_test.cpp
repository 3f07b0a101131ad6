// The scene of K06 section 4 through the fake HD library.
#include <algorithm>
#include <cmath>

#include "core/support/allocations.hpp"
#include "core/support/paper_scene.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/fake_hd.hpp"
#include "runtime/support/patient.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

struct Run {
  std::vector<Snapshot> snapshots;
  std::vector<fake_hd_record> log;
  Scene scene;
  ForceLimits limits;
};

/// One stroke into the membrane and out of it. Fig. 10: a thickness of 0.1 mm.
Run run(double rate, bool ideal, unsigned long long seed = 3) {
  reset_fake_hd([&](fake_hd_settings& s) {
    s.ideal = ideal;
    s.seed = seed;
  });
  const auto ticks = static_cast<std::size_t>(3.2 * rate);
  auto device = std::make_shared<OpenHapticsDevice>(with_fake_hd(rate));
  REQUIRE(device->info().rate == rate);
  fake_hd().restart();
  ServoLoop loop(device, paper_scene(1e-4), patient());
  auto& ring = loop.listen(8192);
  loop.arm();
  loop.start();
  until_tick(ticks + 1);
  loop.stop();
  Run r{{}, fake_hd_log(), loop.scene(), loop.limits()};
  ring.pop(ticks, [&](const Snapshot& s) { r.snapshots.push_back(s); });
  REQUIRE(r.snapshots.size() == ticks);
  CHECK(fake_hd().misuses() == 0);
  return r;
}

Strokes the_stroke() { return {{0, 5e-3, 0}, {0, -10e-3, 0}, 1, 1.0, 0.6, 0.0}; }

double largest_force(const Run& r) {
  double largest = 0;
  for (const auto& s : r.snapshots) largest = std::max(largest, std::abs(s.force[1]));
  return largest;
}

}  // namespace

TEST_CASE("the HD device gets the forces of the core at the same positions, bit for bit, and they reach the motors" *
          doctest::test_suite("numbers")) {
  for (double rate : {1600.0, 1000.0, 2000.0}) {
    const Run r = run(rate, false);
    ServoStep offline = build(r.scene, {}, r.limits);
    bool same = true, felt = true, recorded = true;
    for (std::size_t k = 0; k < r.snapshots.size(); ++k) {
      const Snapshot& live = r.snapshots[k];
      if (live.commands & command_arm) offline.arm();
      const Snapshot& again = offline.step(live.sample);
      same = same && live.force == again.force && live.model_force == again.model_force;
      const auto& record = r.log[k];
      for (std::size_t i = 0; i < 3; ++i) {
        felt = felt && record.force[i] == live.force[i];
        recorded = recorded && live.sample.position[i] == 1e-3 * record.position[i];
      }
    }
    CHECK(same);
    CHECK(felt);
    CHECK(recorded);
    CHECK(largest_force(r) > 0.5);
    CHECK(r.snapshots.back().fault == Fault::none);
  }
}

TEST_CASE("hand, device and scene behave through the HD library as they do offline") {
  const Run r = run(1600, false, 7);
  Experiment offline(paper_scene(1e-4), StrokesMotion(the_stroke(), 7), Vector3d(0, -1, 0), {}, {}, 7);
  double position_error = 0, force_error = 0;
  for (const Snapshot& live : r.snapshots) {
    const Snapshot& s = offline.step();
    position_error = std::max(position_error, std::abs(s.sample.position[1] - live.sample.position[1]));
    force_error = std::max(force_error, std::abs(s.force[1] - live.force[1]));
  }
  CHECK(position_error < 1e-12);  // the conversion to millimetres and back rounds the last digits
  CHECK(force_error < 1e-9);
}

TEST_CASE("on an exact path, the force equals the offline curve within the motion of one tick; sliding, also the law" *
          doctest::test_suite("numbers")) {
  for (double rate : {1600.0, 1000.0}) {
    const Run r = run(rate, true);
    auto insertion = build_insertion(r.scene);
    StrokesMotion motion(the_stroke(), 3);
    std::vector<double> offline;
    for (std::size_t k = 0; k <= r.snapshots.size(); ++k)
      offline.push_back(insertion.step(motion.at(static_cast<double>(k) / rate).position, {0, -1, 0}).y());

    const ThickLaw law(r.scene.needle, r.scene.membranes[0].membrane);
    std::size_t steady = 0;
    for (std::size_t k = 1; k + 1 < r.snapshots.size(); ++k) {
      const Snapshot& s = r.snapshots[k];
      const auto [low, high] = std::minmax({offline[k - 1], offline[k], offline[k + 1]});
      REQUIRE(s.force[1] >= low - 1e-9);
      REQUIRE(s.force[1] <= high + 1e-9);
      const auto& membrane = s.membranes[0];
      if (membrane.phase != Phase::sliding_in) continue;
      ++steady;
      REQUIRE(s.force[1] == doctest::Approx(-law.band(membrane.depth).lower).epsilon(1e-9));
    }
    CHECK(steady > 100);
  }
}

TEST_CASE("a tick allocates no memory" * doctest::test_suite("numbers")) {
  reset_fake_hd();
  ServoLoop loop(std::make_shared<OpenHapticsDevice>(with_fake_hd()), paper_scene(), patient());
  loop.arm();
  loop.start();
  until_tick(1000);
  const auto before = allocations();
  until_tick(20000);
  CHECK(allocations() == before);
}
