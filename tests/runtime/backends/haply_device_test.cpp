#include "punctura_runtime/backends/haply/haply_device.hpp"

#include <doctest/doctest.h>

#include "core/support/paper_scene.hpp"
#include "core/support/tick.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hanging_tick.hpp"
#include "runtime/support/haply_fake.hpp"
#include "runtime/support/patient.hpp"
#include "runtime/support/soon.hpp"

using namespace punctura;
using namespace punctura::test;
using haply::HaplyDevice;
using haply::HaplyOptions;

namespace {

/// Runs as fast as answers arrive. Long timeouts, because the computer may be busy.
HaplyOptions unhurried(const HaplyFake& fake) {
  HaplyOptions options;
  options.url = fake.url();
  options.real_time = false;
  options.stale = 30;
  return options;
}

void until(const std::function<bool()>& done) {
  while (!done()) std::this_thread::yield();
}

}  // namespace

TEST_CASE("K06 Fig. 10 through the service equals the offline experiment, bit for bit, with both forms of the command" *
          doctest::test_suite("numbers")) {
  const std::uint64_t ticks = 5000;
  const std::pair<const char*, const char*> generations[] = {{"3.5.2", "vector"}, {"3.4.9", "values"}, {"", "values"}};
  for (const auto& generation : generations) {
    const char *version = generation.first, *key = generation.second;
    CAPTURE(version);
    FakeSettings settings;
    settings.version = version;
    settings.takes = key;
    HaplyFake fake(settings);
    auto device = std::make_shared<HaplyDevice>(unhurried(fake));
    ServoLoop loop(device, paper_scene(1e-4), patient());
    auto& ring = loop.listen(8192);
    fake.begin();
    loop.arm();
    loop.start();
    until([&] { return loop.report().ticks > ticks; });
    loop.stop();
    CHECK(loop.latest().fault == Fault::none);

    // The plant's motion, its forces, and the forces of a separate step at the same positions are identical.
    Experiment experiment(paper_scene(1e-4), StrokesMotion(settings.strokes, settings.seed), Vector3d(0, -1, 0), {}, {},
                          settings.seed);
    ServoStep replay = build(paper_scene(1e-4));
    replay.arm();
    const auto at_plant = fake.forces();
    REQUIRE(at_plant.size() >= ticks);
    bool same = true, replayed = true, arrived = true;
    double peak = 0;
    ring.pop(ticks, [&](const Snapshot& live) {
      const Snapshot& offline = experiment.step();
      same = same && live.force == offline.force && live.sample.position == offline.sample.position;
      replayed = replayed && replay.step(live.sample).force == live.force;
      arrived = arrived && at_plant[live.tick] == live.force;
      peak = std::max(peak, live.force[1]);
    });
    CHECK(same);
    CHECK(replayed);
    CHECK(arrived);
    CHECK(peak == doctest::Approx(0.73).epsilon(0.02));
    CHECK(at_plant.back() == zero);
  }
}

TEST_CASE("after every failure the plant's force is zero at once and stays zero, with a message") {
  const std::pair<Mishap, const char*> cases[] = {
      {Mishap::removed, "The Inverse3 049D is no longer in the service's list"},
      {Mishap::closes, "closed the connection: \"going away\""},
      {Mishap::silent, "did not answer within 2000 ms"},
      {Mishap::malformed, "not JSON"},
      {Mishap::oversized, "too long"},
      {Mishap::masked, "violates the WebSocket protocol"},
      {Mishap::cut_off, "closed the connection"},
      {Mishap::no_position, "reports no position"},
      {Mishap::no_power, "its power supply"},
  };
  for (const auto& mishap_and_words : cases) {
    const Mishap mishap = mishap_and_words.first;
    const char* words = mishap_and_words.second;
    CAPTURE(words);
    HaplyFake fake;
    HaplyOptions options = unhurried(fake);
    if (mishap == Mishap::silent) options.stale = 2;  // long enough for a busy computer to reach the mishap
    auto device = std::make_shared<HaplyDevice>(options);
    ServoLoop loop(device, paper_scene(), patient());
    fake.begin();
    fake.happen(mishap, 2000);  // in the tissue, under force
    loop.arm();
    loop.start();
    until([&] { return !device->trouble().empty(); });
    until([&] { return loop.latest().fault != Fault::none && fake.client_left(); });
    CHECK(loop.latest().fault == Fault::device);
    CHECK(loop.latest().force == zero);
    CHECK_MESSAGE(device->trouble().find(words) != std::string::npos, device->trouble());
    const auto ticks = loop.report().ticks;
    CHECK_THROWS_AS(ServoLoop(device, paper_scene(), patient()).start(),
                    DeviceError);  // the first loop's stop would end its ticks
    loop.stop();
    CHECK(loop.report().ticks == ticks);  // one more tick reports the fault; then no tick follows

    const auto forces = fake.forces();
    const std::size_t at = fake.mishap_at();
    REQUIRE(at >= 2000);
    REQUIRE(forces.size() >= at + 16);  // 10 ms of the plant's time
    CHECK(forces[at - 1][1] > 0.3);
    bool still = true;
    for (std::size_t i = at; i < forces.size(); ++i) still = still && forces[i] == zero;
    CHECK(still);
  }
}

TEST_CASE("a missing grip releases its buttons at once, and is reported after 0.25 s") {
  HaplyFake fake;
  auto device = std::make_shared<HaplyDevice>(unhurried(fake));
  CHECK(device->info().has_orientation);
  ServoLoop loop(device, paper_scene(), patient());
  auto& ring = loop.listen(4096);
  fake.begin();
  fake.happen(Mishap::no_grip, 100);
  loop.start();
  until([&] { return !device->trouble().empty(); });
  loop.stop();
  CHECK(device->trouble().find("grip") != std::string::npos);
  std::uint64_t held = 0, let_go = 0;
  ring.pop(4096, [&](const Snapshot& s) {
    ++(s.sample.buttons == 5 ? held : let_go);
    CHECK(s.sample.axis == std::array<double, 3>{0, -1, 0});
  });
  CHECK(held == 100);
  CHECK(let_go == 401);
}

TEST_CASE("split, merged and fragmented answers, with pings between, give the same result") {
  for (Travel how : {Travel::byte_by_byte, Travel::in_fragments, Travel::with_pings}) {
    HaplyFake fake;
    fake.travel(how);
    auto device = std::make_shared<HaplyDevice>(unhurried(fake));
    ServoLoop loop(device, paper_scene(), patient());
    fake.begin();
    loop.arm();
    loop.start();
    until([&] { return loop.report().ticks > 300 || !device->trouble().empty(); });
    loop.stop();
    CHECK(device->trouble() == "");
  }
}

TEST_CASE("stop sends zero force; a second stop or one before the start is harmless; the device can start again") {
  HaplyFake fake;
  auto device = std::make_shared<HaplyDevice>(unhurried(fake));
  struct Count {
    std::atomic<int> n{0};
  } count;
  const Tick tick{[](void* to, const DeviceSample&) noexcept -> Tick::Force {
                    ++static_cast<Count*>(to)->n;
                    return {0, 1, 0};
                  },
                  &count, device->info().max_force};
  fake.begin();
  for (int round = 0; round < 2; ++round) {
    const int before = count.n;
    device->start(tick);
    until([&] { return count.n > before + 50; });
    device->stop();
    const int after = count.n;
    until([&] { return fake.client_left(); });
    CHECK(fake.forces().back() == zero);
    CHECK(fake.forces()[fake.forces().size() - 150][1] == doctest::Approx(1));
    device->stop();
    CHECK(count.n == after);
  }
  HaplyDevice never_started(unhurried(fake));
}

TEST_CASE("if a tick does not return, stop() sends zero force meanwhile") {
  HaplyFake fake;
  HaplyDevice device(unhurried(fake));
  HangingTick model(100);
  fake.begin();
  device.start(model.tick());
  CHECK(soon([&] { return model.inside(); }));
  CHECK(fake.forces().back()[1] == doctest::Approx(1));
  std::thread stops([&] { device.stop(); });
  CHECK(soon([&] { return fake.client_left(); }));
  CHECK(fake.forces().back() == zero);
  CHECK(model.inside());
  model.returns = true;
  stops.join();
  CHECK(fake.forces().back() == zero);
}

namespace {
std::atomic<std::int64_t> fake_now{0};
std::int64_t fake_clock() noexcept { return fake_now; }
}  // namespace

TEST_CASE("with a slow service the measured rate is used; it is measured with zero force") {
  HaplyFake fake;
  fake.on_message = [] { fake_now += 2'000'000; };
  HaplyOptions options;
  options.url = fake.url();
  options.now_ns = fake_clock;
  options.realtime = {0, -1, false, false};
  CHECK(HaplyDevice(options).info().rate == doctest::Approx(500));
  options.rate = 400;
  const HaplyDevice paced(options);
  CHECK(paced.info().rate == 400);
  const auto statements = paced.statements();
  CHECK(statements.front() == "haply: tested against a simulated service only");
  CHECK(statements.at(1) == "the service answers 500 times a second; the rate is 400 Hz");
}
