// Two devices: the needle in one hand, the plunger of its syringe under the other thumb.
#include "punctura_runtime/loop/thumb_loop.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "core/support/allocations.hpp"
#include "core/support/tick.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

std::atomic<std::int64_t> two_hands_ns{0};
std::int64_t now() noexcept { return two_hands_ns; }

/// Both devices tick in turn, 1600 times a second of the test's own clock. The thumb moves along -y.
struct TwoHands {
  TwoHands() {
    two_hands_ns = 1'000'000'000;
    Scene scene = paper_scene(12e-3);
    scene.membranes[0].outflow_behind = {5e8, 1000};
    scene.syringe = SyringeSettings{{15e-3, 4e-6, 0.3e-6, 0.5, 1e-12, 2e9}, {2000, 2}};
    thumb_loop = std::make_shared<ThumbLoop>(thumb, ThumbSettings{.now_ns = now});
    LoopSettings settings;
    settings.thumb = thumb_loop;
    settings.now_ns = now;
    loop = std::make_unique<ServoLoop>(needle, scene, settings);
  }
  void tick(double needle_y, double thumb_depth, bool needle_ticks = true, bool thumb_ticks = true) {
    two_hands_ns += 625'000;
    if (thumb_ticks) felt = thumb->tick(-thumb_depth)[1];
    if (needle_ticks) force = needle->tick(needle_y);
  }
  void many(int n, double needle_from, double needle_to, double thumb_from, double thumb_to) {
    for (int i = 1; i <= n; ++i)
      tick(needle_from + (needle_to - needle_from) * i / n, thumb_from + (thumb_to - thumb_from) * i / n);
  }
  /// Armed, past the ramp, the whole opening in the wall, the thumb 2 mm in.
  void press_in_the_wall() {
    loop->start();
    loop->arm();
    many(1600, 1e-3, 1e-3, 0, 0);
    many(1600, 1e-3, -9e-3, 0, 0);
    many(1600, -9e-3, -9e-3, 0, 2e-3);
  }

  std::shared_ptr<HandCranked> needle = std::make_shared<HandCranked>(), thumb = std::make_shared<HandCranked>();
  std::shared_ptr<ThumbLoop> thumb_loop;
  std::unique_ptr<ServoLoop> loop;
  Tick::Force force{};
  double felt = 0;  ///< N, along y: positive pushes the thumb out
};

}  // namespace

TEST_CASE("the thumb feels the plunger hold in the wall and give way behind it") {
  TwoHands hands;
  hands.press_in_the_wall();
  const double held = hands.felt;
  CHECK(held > 1);
  CHECK(hands.thumb_loop->force() == doctest::Approx(-held));
  CHECK(hands.loop->latest().sample.thumb == doctest::Approx(2e-3));
  CHECK(hands.loop->latest().syringe.left < 0.05e-6);
  hands.many(3200, -9e-3, -26e-3, 2e-3, 2e-3);
  hands.many(1600, -26e-3, -26e-3, 2e-3, 2e-3);
  CHECK(hands.felt < 0.7 * held);
  CHECK(hands.loop->latest().syringe.left > 0.1e-6);
}

TEST_CASE("the thumb gets force only while the needle's device gets force") {
  TwoHands hands;
  hands.press_in_the_wall();
  hands.loop->pause();
  hands.many(3, -9e-3, -9e-3, 2e-3, 2e-3);
  CHECK(hands.felt == 0);
  CHECK(hands.loop->latest().syringe.force < -1);  // the model continues
}

TEST_CASE("a fault of the thumb's device ends the force of both") {
  TwoHands hands;
  hands.press_in_the_wall();
  REQUIRE(hands.force != zero);
  hands.tick(-9e-3, std::nan(""));
  CHECK(hands.felt == 0);
  CHECK(hands.force == zero);
  CHECK(hands.thumb_loop->fault() == Fault::non_finite_input);
  CHECK(hands.loop->latest().fault == Fault::thumb);
  hands.many(10, -9e-3, -9e-3, 2e-3, 2e-3);
  CHECK(hands.felt == 0);
  CHECK(hands.force == zero);
}

TEST_CASE("a fault of the needle's device ends the force of both") {
  TwoHands hands;
  hands.press_in_the_wall();
  hands.tick(std::nan(""), 2e-3);
  CHECK(hands.force == zero);
  hands.tick(-9e-3, 2e-3);
  CHECK(hands.felt == 0);
}

TEST_CASE("silence of one device ends the force of the other within the deadline") {
  {
    TwoHands hands;
    hands.press_in_the_wall();
    for (int i = 0; i < 40; ++i) hands.tick(-9e-3, 2e-3, true, false);  // 25 ms
    CHECK(hands.force == zero);
    CHECK(hands.loop->latest().fault == Fault::thumb);
  }
  TwoHands hands;
  hands.press_in_the_wall();
  for (int i = 0; i < 40; ++i) hands.tick(-9e-3, 2e-3, false, true);
  CHECK(hands.felt == 0);
}

TEST_CASE("a reset clears both faults and fills the syringe; the thumb's place is the plunger's start") {
  TwoHands hands;
  hands.press_in_the_wall();
  hands.tick(-9e-3, std::nan(""));
  hands.loop->reset();
  hands.many(10, 1e-3, 1e-3, 2e-3, 2e-3);
  CHECK(hands.loop->latest().fault == Fault::none);
  CHECK(hands.thumb_loop->fault() == Fault::none);
  CHECK(hands.loop->latest().sample.thumb == 0);
  CHECK(hands.loop->latest().syringe.left < 1e-15);
}

TEST_CASE("a thumb's device that never ticks causes a fault after a second") {
  TwoHands hands;
  hands.loop->start();
  for (int i = 0; i < 1500; ++i) hands.tick(1e-3, 0, true, false);
  CHECK(hands.loop->latest().fault == Fault::none);
  for (int i = 0; i < 200; ++i) hands.tick(1e-3, 0, true, false);
  CHECK(hands.loop->latest().fault == Fault::thumb);
}

TEST_CASE("the ratings of the thumb's device limit its force, and both ticks allocate no memory") {
  TwoHands hands;
  auto weak = std::make_shared<HandCranked>();
  weak->described().max_force = 0.5;
  ThumbLoop limited(weak);
  CHECK(limited.limits().max_force == 0.5);
  limited.start();
  CHECK(weak->given().max_force == 0.5);
  hands.press_in_the_wall();
  const std::size_t before = allocations();
  hands.many(1000, -9e-3, -12e-3, 2e-3, 3e-3);
  CHECK(allocations() == before);
}

TEST_CASE("a change of the scene causes no jump of the thumb's force") {
  const auto largest_step = [](TwoHands& hands) {
    double largest = 0, before = hands.felt;
    for (int i = 0; i < 800; ++i) {
      hands.tick(-9e-3, 2e-3);
      largest = std::max(largest, std::abs(hands.felt - before));
      before = hands.felt;
    }
    return largest;
  };
  TwoHands other_contents, other_scale, other_coupling;
  for (TwoHands* hands : {&other_contents, &other_scale, &other_coupling}) {
    hands->press_in_the_wall();
    Scene scene = hands->loop->scene();
    if (hands == &other_contents) scene.syringe->syringe.air = 1.3e-6;
    if (hands == &other_coupling) scene.syringe->thumb.stiffness *= 100;
    if (hands == &other_scale) scene.display.force_scale = 0.2;
    std::thread change([&] { hands->loop->exchange(scene); });
    double largest = 0;
    for (int i = 0; i < 10; ++i) largest = std::max(largest, largest_step(*hands));
    change.join();
    largest = std::max(largest, largest_step(*hands));
    CHECK(largest < 0.05);
  }
  CHECK(std::abs(other_contents.felt) < 0.5);  // the new syringe starts full, where the thumb is
  CHECK(other_scale.felt > 0.1);
}

TEST_CASE("the plunger starts where the thumb is in the needle's first tick") {
  TwoHands hands;
  hands.loop->start();
  hands.loop->arm();
  for (int i = 0; i < 100; ++i) hands.tick(1e-3, 2e-4 * i, false, true);  // the needle's driver is late
  double largest = 0;
  for (int i = 0; i < 1600; ++i) {
    hands.tick(1e-3, 20e-3);
    largest = std::max(largest, std::abs(hands.loop->latest().syringe.force));
  }
  CHECK(largest < 1);
}

TEST_CASE("in a scene without a syringe the thumb gets no force and has no fault, also after a change of the scene") {
  TwoHands hands;
  Scene with = hands.loop->scene(), without = with;
  without.syringe.reset();
  hands.loop->exchange(without);
  hands.loop->start();
  hands.loop->arm();
  hands.many(1600, 1e-3, 1e-3, 0, 5e-3);
  CHECK(hands.felt == 0);
  CHECK(hands.thumb_loop->fault() == Fault::none);
  CHECK(hands.loop->latest().fault == Fault::none);
  std::thread change([&] { hands.loop->exchange(with); });
  hands.many(800, 1e-3, 1e-3, 5e-3, 5e-3);
  change.join();
  hands.many(100, 1e-3, 1e-3, 5e-3, 5e-3);
  CHECK(hands.loop->latest().fault == Fault::none);
  CHECK(std::abs(hands.loop->latest().syringe.force) < 1);
}

TEST_CASE("a thumb's device runs in one loop at a time, and the other loop cannot stop it") {
  TwoHands hands;
  hands.press_in_the_wall();
  LoopSettings settings;
  settings.thumb = hands.thumb_loop;
  ServoLoop second(std::make_shared<HandCranked>(), hands.loop->scene(), settings);
  CHECK_THROWS_AS(second.start(), DeviceError);
  second.stop();
  CHECK(hands.thumb->started());
  hands.tick(-9e-3, 2e-3);
  CHECK(hands.felt > 1);
}

TEST_CASE("the record contains the thumb's felt force") {
  TwoHands hands;
  hands.press_in_the_wall();
  CHECK(hands.loop->latest().sample.thumb_felt == doctest::Approx(-hands.felt).epsilon(0.01));
}

TEST_CASE("a stop ends both devices, and one device cannot serve both hands") {
  TwoHands hands;
  hands.press_in_the_wall();
  hands.loop->stop();
  CHECK_FALSE(hands.needle->started());
  CHECK_FALSE(hands.thumb->started());
  LoopSettings settings;
  settings.thumb = std::make_shared<ThumbLoop>(hands.needle);
  CHECK_THROWS_AS(ServoLoop(hands.needle, paper_scene(), settings), std::invalid_argument);
  CHECK_THROWS_AS(ThumbLoop(hands.thumb, ThumbSettings{.direction = {0, 0, 0}}), std::invalid_argument);
}

TEST_CASE("a simulated thumb pushes without a second device") {
  auto device = std::make_shared<HandCranked>();
  Scene scene = paper_scene(12e-3);
  scene.syringe = SyringeSettings{{15e-3, 4e-6, 0.3e-6, 0.5, 1e-12, 2e9}, {2000, 2}};
  ServoLoop loop(device, scene);
  loop.start();
  device->move(1e-3, -9e-3, 1600);
  CHECK(loop.latest().sample.thumb == 0);
  loop.push_plunger(3);
  device->move(-9e-3, -9e-3, 3200);
  CHECK(loop.latest().syringe.force == doctest::Approx(-3).epsilon(0.01));
  const double pushed = loop.latest().sample.thumb;
  loop.push_plunger(std::nan(""));  // counts as 0: the thumb releases and does not jump
  device->move(-9e-3, -9e-3, 1);
  CHECK(loop.latest().sample.thumb == doctest::Approx(pushed).epsilon(0.01));
  loop.push_plunger(0);
  device->move(-9e-3, -9e-3, 3200);
  CHECK(loop.latest().syringe.force > -0.6);
}
