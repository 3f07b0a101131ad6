// Motors do not cool because a new run begins.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <vector>

#include "core/support/cases.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
/// A clock that only the test advances, and the settings of a loop that uses it.
std::atomic<std::int64_t> clock_ns{0};
LoopSettings by_test_clock() {
  LoopSettings settings;
  settings.now_ns = []() noexcept { return clock_ns.load(); };
  return settings;
}

/// A wall so stiff that the force reaches every limit.
Scene stiff_scene() {
  Scene scene = paper_scene();
  scene.membranes[0].membrane.stiffness *= 20;
  scene.membranes[0].membrane.precompression *= 20;
  return scene;
}

/// A loop on its own device, armed, after a second in front of the wall.
struct ArmedRun {
  std::shared_ptr<HandCranked> device = std::make_shared<HandCranked>();
  ServoLoop loop{device, stiff_scene(), by_test_clock()};

  ArmedRun() {
    loop.start();
    loop.arm();
    device->move(2e-3, 1e-3, 1600);
  }
};

/// The forces that a device got in many runs, one for each tick.
class Felt {
 public:
  void add(const Tick::Force& force) { squares_.push_back(to_vector(force).squaredNorm()); }
  /// The greatest rms over any 10 s, N.
  double worst(double rate = 1600) const {
    const auto window = static_cast<std::size_t>(10 * rate);
    double sum = 0, worst = 0;
    for (std::size_t k = 0; k < squares_.size(); ++k) {
      sum += squares_[k] - (k >= window ? squares_[k - window] : 0);
      worst = std::max(worst, sum);
    }
    return std::sqrt(worst / static_cast<double>(window));
  }

 private:
  std::vector<double> squares_;
};
}  // namespace

TEST_CASE("in many random runs on one device, no window of 10 s exceeds its rating") {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(0, 1);
  auto device = std::make_shared<HandCranked>();
  Felt felt;
  double y = 2e-3;
  const auto move = [&](double to, int ticks) {
    for (int i = 1; i <= ticks; ++i) {
      felt.add(device->tick(y + (to - y) * i / ticks));
      clock_ns += 625'000;
    }
    y = to;
  };
  for (int run = 0; run < at_most(1000); ++run) {
    ServoLoop loop(device, stiff_scene(), by_test_clock());
    loop.start();
    loop.arm();
    move(1e-3, 20);
    const int strokes = static_cast<int>(3 * share(random));
    for (int stroke = 0; stroke <= strokes; ++stroke) {
      const double depth = 2e-3 + 6e-3 * share(random);  // drawn in a fixed order: compilers evaluate arguments in any
      move(-depth, 100 + static_cast<int>(1500 * share(random)));
      if (run % 100 == 0 && stroke == 0) loop.exchange(stiff_scene());  // rarely: it waits for a tick
      if (share(random) < 0.1) loop.reset();
      if (share(random) < 0.3) move(1e-3, 200);
      loop.arm();
    }
    loop.stop();
  }
  CHECK(felt.worst() <= 0.88 * (1 + 1e-9));
  CHECK(felt.worst() > 0.6);
}

TEST_CASE("the force that a device holds after its last tick counts until the stop") {
  ArmedRun run;
  auto& [device, loop] = run;
  clock_ns += 1'000'000'000;
  const auto held = to_vector(device->move(1e-3, -6e-3, 400)).squaredNorm();
  REQUIRE(held > 3);
  clock_ns += 200'000'000;  // no more ticks
  loop.stop();
  CHECK(device->motor_use.spent > 0.15 * held);
}

TEST_CASE("time between two runs counts as rest; a run that follows at once has no rest") {
  auto device = std::make_shared<HandCranked>();
  {
    ServoLoop loop(device, stiff_scene(), by_test_clock());
    CHECK(loop.spent() == 0);
    loop.start();
    loop.arm();
    device->move(2e-3, 1e-3, 1600);
    device->move(1e-3, -6e-3, 1600);
    device->move(-6e-3, -6e-3, 1600);
  }
  const double spent = device->motor_use.spent;
  CHECK(spent > 1);
  ServoLoop at_once(device, stiff_scene(), by_test_clock());
  CHECK(at_once.spent() == spent);
  clock_ns += 1'000'000'000;
  ServoLoop later(device, stiff_scene(), by_test_clock());
  CHECK(later.spent() == doctest::Approx(spent - 0.75 * 0.88 * 0.88));
  clock_ns += 60'000'000'000;
  ServoLoop much_later(device, stiff_scene(), by_test_clock());
  CHECK(much_later.spent() == 0);
}

TEST_CASE("a restarted loop continues with the force budget that its device has used") {
  ArmedRun run;
  auto& [device, loop] = run;
  CHECK(loop.latest().ceiling == 3.3);
  device->move(1e-3, -6e-3, 1600);
  loop.stop();
  REQUIRE(loop.spent() > 1);
  loop.start();
  device->tick(2e-3);
  CHECK(loop.latest().ceiling < 3.3);
  loop.stop();
  clock_ns += 60'000'000'000;  // the time also counts as rest for a restarted loop
  loop.start();
  device->tick(2e-3);
  CHECK(loop.latest().ceiling == 3.3);
}
