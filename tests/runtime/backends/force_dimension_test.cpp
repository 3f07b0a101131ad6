#include "punctura_runtime/backends/force_dimension/device.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/support/allocations.hpp"
#include "fakes/drd/rig.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "runtime/support/patient.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// One membrane, 0.1 mm: the scene of K06 Fig. 10.
Scene figure_10(double rate) {
  Scene scene = paper_scene(1e-4);
  scene.servo.rate = rate;
  return scene;
}

struct Record {
  DeviceSample sample;
  std::uint32_t commands;
  std::array<double, 3> model_force, force;
  Fault fault;
};

std::vector<Record> taken(SnapshotRing& ring) {
  std::vector<Record> all;
  ring.pop(1 << 20, [&](const Snapshot& s) { all.push_back({s.sample, s.commands, s.model_force, s.force, s.fault}); });
  return all;
}

/// One stroke in and out, down along the fake's z, from the first tick on.
constexpr fake_drd::Strokes stroke{{0, 0, 5e-3}, {0, 0, -10e-3}, 1, 1.0, 0.6, 0, 0};
const Strokes same_stroke{{0, 5e-3, 0}, {0, -10e-3, 0}, 1, 1.0, 0.6, 0};

std::vector<Record> play(FakeRig& rig, double rate) {
  rig.loop.arm();
  rig.start();
  fake().strokes(&stroke);
  std::vector<Record> all;
  for (int i = 0; i < 19; ++i) {
    rig.run(0.2);
    for (const Record& r : taken(*rig.ring)) all.push_back(r);
  }
  CHECK(static_cast<double>(all.size()) >= 3.8 * rate - 1);
  return all;
}

}  // namespace

TEST_CASE("through the fake library, recorded positions give the same forces as offline, bit for bit" *
          doctest::test_suite("numbers")) {
  for (double rate : {1600.0, 4000.0}) {
    CAPTURE(rate);
    auto settings = upright();
    settings.repeat_every = 11;
    FakeRig rig(settings, rate, figure_10(1600), {}, 1024);
    const auto live = play(rig, rate);

    ServoStep offline = build(figure_10(rate), {}, rig.loop.limits());
    std::size_t same = 0, felt = 0;
    for (const Record& r : live) {
      if (r.commands & command_arm) offline.arm();
      const Snapshot& s = offline.step(r.sample);
      same += s.model_force == r.model_force && s.force == r.force;
      felt += r.force[1] > 0.2;
    }
    CHECK(same == live.size());
    CHECK(felt > rate / 2);
    CHECK(rig.device->repeated() > rate / 4);
    CHECK(rig.loop.latest().fault == Fault::none);
    CHECK(rig.device->trouble() == "");
  }
}

TEST_CASE("through the fake library, the force-position curve equals the offline experiment within one tick's motion" *
          doctest::test_suite("numbers")) {
  for (double rate : {1600.0, 4000.0}) {
    CAPTURE(rate);
    auto settings = upright();
    settings.encoder_step = settings.friction = settings.tremor = 0;
    FakeRig rig(settings, rate, figure_10(1600), {}, 1024);
    const auto live = play(rig, rate);

    DeviceDynamics dynamics;
    dynamics.encoder_step = dynamics.friction = 0;
    dynamics.max_force = settings.motor_force;
    Hand hand;
    hand.tremor_rms = 0;
    Experiment experiment(figure_10(rate), StrokesMotion(same_stroke, 0), Vector3d(0, -1, 0), dynamics, hand);
    std::vector<std::pair<double, double>> curve;
    double fastest = 0;
    for (std::size_t k = 0; k < live.size(); ++k) {
      const Snapshot& s = experiment.step();
      curve.emplace_back(s.sample.position[1], s.model_force[1]);
      if (k > 0) fastest = std::max(fastest, std::abs(curve[k].first - curve[k - 1].first));
    }
    double worst_p = 0, worst_f = 0;
    for (std::size_t k = 2; k + 2 < live.size(); ++k) {
      worst_p = std::max(worst_p, std::abs(live[k].sample.position[1] - curve[k].first));
      double best = 1e9;
      for (std::size_t j = k - 2; j <= k + 2; ++j)
        best = std::min(best, std::abs(live[k].model_force[1] - curve[j].second));
      worst_f = std::max(worst_f, best);
    }
    CHECK(worst_p <= fastest);
    CHECK(worst_f < 1e-3);
    MESSAGE("at " << rate << " Hz: positions within " << worst_p * 1e6 << " um (one tick's motion: " << fastest * 1e6
                  << " um), forces within " << worst_f * 1e3 << " mN");
  }
}

TEST_CASE("positions, directions and forces are rotated into the device's axes and back") {
  using namespace force_dimension;
  CHECK(to_ours({1, 2, 3}) == Triple{2, 3, 1});  // x to the user, y right, z up: right, up, to the user
  CHECK(to_device(to_ours({1, 2, 3})) == Triple{1, 2, 3});

  FakeRig rig;
  fake().target(0.001, 0.002, 0.005);
  rig.start();
  rig.run(0.01);
  const auto& at = rig.loop.latest().sample;
  CHECK(at.position[0] == doctest::Approx(0.002).epsilon(0.05));
  CHECK(at.position[1] == doctest::Approx(0.005).epsilon(0.05));
  CHECK(at.position[2] == doctest::Approx(0.001).epsilon(0.05));
  CHECK(at.axis == std::array<double, 3>{0, -1, 0});  // the handle points down
}

TEST_CASE("an upward force stays upward: the loop's y is the device's z") {
  FakeRig rig;
  rig.push_in();
  const auto force = rig.loop.latest().force;
  const auto fake_now = fake().state();
  CHECK(force[1] > 0.2);
  CHECK(fake_now.sent[0] == force[2]);
  CHECK(fake_now.sent[1] == force[0]);
  CHECK(fake_now.sent[2] == force[1]);
  CHECK(fake_now.force[2] == force[1]);
}

TEST_CASE("a tool direction other than the usual one can be set") {
  const auto settings = upright();
  fake().reset(&settings);
  force_dimension::Options options;
  options.library = PUNCTURA_FAKE_DRD;
  options.tool = {0, 0, 2};  // the frame's third column: -x of the device, away from the user
  fake().virtual_time(1);
  CrankedClock::reset();
  options.clock = CrankedClock::clock();
  options.realtime = {0, -1, false, false};
  const auto device = std::make_shared<force_dimension::ForceDimensionDevice>(options);
  ServoLoop loop(device, paper_scene(), patient());
  loop.start();
  CrankedClock::run_to(fake().now() + 10'000'000, *device);
  CHECK(loop.latest().sample.axis == std::array<double, 3>{0, 0, -1});
  CrankedClock::release();
  loop.stop();
  options.tool = {0, 0, 0};
  CHECK_THROWS_AS(force_dimension::ForceDimensionDevice{options}, DeviceError);
}

TEST_CASE("buttons come with the samples") {
  LoopSettings settings;
  settings.gate.dead_man = 2;
  FakeRig rig(upright(), 1600, paper_scene(), settings);
  rig.loop.arm();
  rig.start();
  rig.run(0.05);
  CHECK(rig.loop.latest().state == ServoState::waiting);
  fake().buttons(2);
  rig.run(0.05);
  CHECK(rig.loop.latest().sample.buttons == 2);
  CHECK(rig.loop.latest().state == ServoState::active);
}

TEST_CASE("a device reports the data of its library and its maker") {
  fake_drd::Settings settings;  // an omega.3: no wrist
  FakeRig omega(settings);
  CHECK(omega.device->info().model == "omega.3");
  CHECK(omega.device->info().serial == "12345");
  CHECK_FALSE(omega.device->info().has_orientation);
  CHECK(omega.device->info().max_force == 12);
  CHECK(omega.device->info().max_stiffness == 5000);
  omega.start();
  omega.run(0.01);
  CHECK(omega.loop.latest().sample.axis == std::array<double, 3>{0, 0, -1});
  const auto statements = omega.device->statements();
  CHECK(std::any_of(statements.begin(), statements.end(),
                    [](const auto& s) { return s.find("simulated libraries only") < s.size(); }));
  CHECK(std::any_of(statements.begin(), statements.end(), [](const auto& s) { return s.find("no wrist") < s.size(); }));
  omega.stop();

  settings.system_type = 60;
  settings.user_max_force = 2.5;
  FakeRig falcon(settings, 9000);
  CHECK(falcon.device->info().model == "Falcon");
  CHECK(falcon.device->info().button_count == 4);
  CHECK(falcon.device->info().max_force == 2.5);
  CHECK(falcon.device->info().rate == 4000);
  CHECK(falcon.loop.limits().max_force == 2.5);
}

TEST_CASE("a slow device ticks at its own possible rate, and T follows") {
  auto settings = upright();
  settings.transfer = 0.9e-3;
  FakeRig rig(settings);
  CHECK(rig.device->info().rate == doctest::Approx(0.95 / 0.9e-3).epsilon(1e-6));
  rig.push_in();
  CHECK(rig.loop.latest().force[1] > 0.2);
  CHECK(rig.loop.scene().servo.rate == rig.device->info().rate);
  CHECK(rig.device->missed() <= 1);
  const auto statements = rig.device->statements();
  CHECK(std::any_of(statements.begin(), statements.end(), [](const auto& s) {
    return s == "rate 1056 Hz, the most at which it can be read, instead of 1600 Hz";
  }));
}

TEST_CASE("force is sent in every tick, also zero, and no protection of the device is switched off") {
  FakeRig rig;
  rig.start();  // not armed
  rig.run(0.5);
  const auto at = fake().state();
  CHECK(at.writes >= rig.loop.report().ticks);
  CHECK(rig.loop.report().ticks >= 799);
  CHECK(at.force_on == 1);
  CHECK(at.last_force == 0);
  CHECK(at.touched_safety == 0);
  CHECK(at.switched_on_by_writer ==
        1);  // after the thread's preparation, which may take longer than the watchdog's time
  CHECK(rig.device->trouble() == "");
}

TEST_CASE("forces above the motors' limit are no fault; they are counted and reported") {
  auto settings = upright();
  settings.motor_force = 0.3;
  FakeRig rig(settings);
  rig.push_in();
  CHECK(rig.loop.latest().fault == Fault::none);
  CHECK(rig.device->saturated() > 10);
  const auto statements = rig.device->statements();
  CHECK(std::any_of(statements.begin(), statements.end(),
                    [](const auto& s) { return s.find("whole force") < s.size(); }));
}

TEST_CASE("a tick allocates no memory" * doctest::test_suite("numbers")) {
  auto settings = upright();
  settings.repeat_every = 7;
  FakeRig rig(settings);
  rig.push_in();
  const std::size_t before = allocations();
  rig.run(0.2);
  const std::size_t after = allocations();
  CHECK(after == before);
}
