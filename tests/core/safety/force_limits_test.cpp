#include "punctura/safety/force_limits.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include "../support/cases.hpp"
#include "../support/tick.hpp"

using namespace punctura;
using namespace punctura::test;
using punctura::test::at_most;

namespace {
ForceLimiter ramped(const ForceLimits& limits = {}) {
  ForceLimiter limiter(limits, T);
  for (int k = 0; k < 1600; ++k) limiter.step(Vector3d::Zero());
  return limiter;
}
}  // namespace

TEST_CASE("after a reset the force increases linearly over half a second") {
  ForceLimiter limiter({}, T);
  for (int k = 1; k <= 800; ++k) CHECK(limiter.step({0, 0.5, 0}).y() == doctest::Approx(0.5 * k / 800.0));
  CHECK(limiter.step({0, 0.5, 0}).y() == 0.5);
  CHECK(limiter.counters().ramp == doctest::Approx(800).epsilon(0.01));
  limiter.reset();
  CHECK(limiter.step({0, 0.5, 0}).y() == doctest::Approx(0.5 / 800));
}

TEST_CASE("the clamp keeps the direction of the force") {
  auto limiter = ramped();
  const Vector3d wanted(3, -4, 12);
  const Vector3d force = limiter.step(wanted);
  CHECK(force.norm() == doctest::Approx(3.3));
  CHECK((force.stableNormalized() - wanted.stableNormalized()).norm() < 1e-15);
  CHECK(limiter.counters().peak == 1);
}

TEST_CASE("a force within the limits is unchanged, bit for bit, and not counted") {
  auto limiter = ramped();
  const Vector3d wanted(0.1, 0.7, -0.2);
  for (int k = 0; k < 1000; ++k) REQUIRE(limiter.step(wanted) == wanted);
  CHECK(limiter.counters().peak == 0);
  CHECK(limiter.counters().continuous == 0);
}

TEST_CASE("the limiter does not smooth the pop") {
  auto limiter = ramped();
  CHECK(limiter.step({0, 0.73, 0}).y() == 0.73);
  CHECK(limiter.step({0, 0.41, 0}).y() == 0.41);
}

namespace {
/// The largest rms of a force over any `window` seconds, N.
class WorstWindow {
 public:
  explicit WorstWindow(double window = 10) : window_(window), squares_(static_cast<std::size_t>(window / T + 1e-9)) {}
  void add(double force) {
    double& oldest = squares_[k_++ % squares_.size()];
    sum_ += force * force - oldest;
    oldest = force * force;
    worst_ = std::max(worst_, sum_);
  }
  double rms() const { return std::sqrt(worst_ * T / window_); }

 private:
  double window_;
  std::vector<double> squares_;  // of the ticks in the window
  std::size_t k_ = 0;
  double sum_ = 0, worst_ = 0;
};
}  // namespace

TEST_CASE("the rms force of each 10 s is within the rating, and the ceiling decreases without a step") {
  auto limiter = ramped();
  WorstWindow worst;
  double last = 3.3, largest_step = 0;
  for (int k = 0; k < 1600 * 60; ++k) {
    worst.add(limiter.step({0, 3, 0}).norm());
    largest_step = std::max(largest_step, std::abs(limiter.ceiling() - last));
    last = limiter.ceiling();
  }
  CHECK(worst.rms() <= 0.88);
  CHECK(worst.rms() > 0.85);
  CHECK(largest_step < 0.02);
  CHECK(last == doctest::Approx(0.88 * std::sqrt(0.75)));  // the largest constant force
  CHECK(limiter.counters().continuous > 0);
  CHECK(limiter.limit() == Limit::continuous);
}

TEST_CASE("the rms force of each 10 s is within the rating for any input, runs and resets") {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> share(0, 1);
  const ForceLimits limits;
  WorstWindow worst;
  double spent = 0;
  for (int run = 0; run < at_most(1000); ++run) {
    ForceLimiter limiter(limits, T);
    limiter.set_spent(spent);
    const auto ticks = static_cast<int>(1600 * 4 * share(random));
    const double strong = 4 * share(random), beat = 40 * share(random);
    for (int k = 0; k < ticks; ++k) {
      if (share(random) < 1e-3) limiter.reset();
      if (share(random) < 0.1 * share(random)) {
        limiter.rest();
        worst.add(0);
      } else {
        worst.add(limiter.step({strong * std::abs(std::sin(beat * k * T)), 0, 0}).norm());
      }
    }
    spent = limiter.budget().spent();
  }
  CHECK(worst.rms() <= 0.88);
  CHECK(worst.rms() > 0.7);
}

TEST_CASE("the rms force is within the rating for late ticks, a slow device and all permitted gaps" *
          doctest::test_suite("numbers")) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> share(0, 1);
  for (const double slowest : {1.0, 1.05, 2.0, 3.2, 10.0, 30.0}) {  // times the period; 32 is 20 ms
    for (const bool always : {true, false}) {
      ForceLimiter limiter({}, T);
      // The largest sum of squared force over any 10 s, in steps of a tenth of a period.
      constexpr double grid = T / 10;
      std::vector<double> energy(static_cast<std::size_t>(40 / grid), 0.0);
      double time = 0, held = 0;
      while (time < 39) {
        const double gap = T * (always ? slowest : 1 + (slowest - 1) * share(random));
        const auto from = static_cast<std::size_t>(time / grid), to = static_cast<std::size_t>((time + gap) / grid);
        for (std::size_t i = from; i < to; ++i) energy[i] += held * held * grid;
        time += gap;
        held = limiter.step({0, 3.3, 0}, 0, gap).norm();
      }
      const auto window = static_cast<std::size_t>(10 / grid);
      double sum = 0, worst = 0;
      for (std::size_t i = 0; i < energy.size(); ++i) {
        sum += energy[i] - (i >= window ? energy[i - window] : 0);
        worst = std::max(worst, sum);
      }
      CAPTURE(slowest);
      CHECK(std::sqrt(worst / 10) <= 0.88 * (1 + 1e-3));  // the grid cuts a gap by a tenth of a period
    }
  }
}

TEST_CASE("a force that is not a number empties the budget, and the budget recovers") {
  ForceBudget budget(10, 0.88);
  budget.spend(std::nan(""), T);
  CHECK(budget.left() == 0);
  budget.spend(0, 20);
  CHECK(budget.left() == 1);
  budget.spend(std::numeric_limits<double>::infinity(), T);
  CHECK(budget.left() == 0);
  budget.spend(0, 20);
  CHECK(budget.left() == 1);
}

TEST_CASE("the ramp is not reported while the model force is zero") {
  ForceLimiter limiter({}, T);
  limiter.step(Vector3d::Zero());
  CHECK(limiter.limit() == Limit::none);
  limiter.step({0, 1, 0});
  CHECK(limiter.limit() == Limit::ramp);
}

TEST_CASE("the rms force is within the rating for limits of any size" * doctest::test_suite("numbers")) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-2, 2);
  for (int i = 0; i < at_most(50); ++i) {
    ForceLimits limits;
    limits.max_force = std::pow(10, exponent(random));
    limits.continuous_force = std::pow(10, exponent(random));
    limits.continuous_time = std::pow(10, exponent(random) / 2);
    ForceLimiter limiter(limits, T);
    WorstWindow worst(limits.continuous_time);
    for (int k = 0; k < 40000; ++k) {
      const double force = limiter.step({0, 100, 0}).norm();
      REQUIRE(force <= limits.max_force * (1 + 1e-12));
      worst.add(force);
    }
    CHECK(worst.rms() <= limits.continuous_force * (1 + 1e-9));
  }
}

TEST_CASE("rest restores the budget and a reset does not") {
  auto limiter = ramped();
  for (int k = 0; k < 1600 * 20; ++k) limiter.step({0, 3, 0});
  const double spent = limiter.ceiling();
  CHECK(spent < 1);
  limiter.reset();
  limiter.rest();
  CHECK(limiter.ceiling() == doctest::Approx(spent).epsilon(1e-2));
  for (int k = 0; k < 1600 * 20; ++k) limiter.rest();
  CHECK(limiter.ceiling() == 3.3);
}

TEST_CASE("ceiling() includes warm motors, and limit() is the limit that reduced the force") {
  auto limiter = ramped();
  limiter.step({0, 2, 0}, 0);
  CHECK(limiter.ceiling() == 3.3);
  CHECK(limiter.limit() == Limit::none);
  CHECK(limiter.step({0, 2, 0}, 0.95).norm() == doctest::Approx(0.825));
  CHECK(limiter.ceiling() == doctest::Approx(0.825));
  CHECK(limiter.limit() == Limit::temperature);
  limiter.rest(1);
  CHECK(limiter.ceiling() == 0);
  CHECK(limiter.limit() == Limit::none);
  for (int k = 0; k < 16001; ++k) limiter.rest();
  limiter.step({0, 5, 0});
  CHECK(limiter.limit() == Limit::peak);
  limiter.reset();
  limiter.step({0, 1, 0});
  CHECK(limiter.limit() == Limit::ramp);
}

TEST_CASE("after a cut by temperature the ceiling rises slowly, also with a sensor that fails now and then") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double bad : {1.2, 0.9, nan}) {
    auto limiter = ramped();
    limiter.step({0, 2, 0}, bad);
    const double cut = limiter.ceiling();
    CHECK(cut == doctest::Approx(bad == 0.9 ? 1.65 : 0));
    double before = cut;
    for (int k = 0; k < 3000; ++k) {  // every second reading is bad: the ceiling stays
      limiter.rest(k % 2 == 0 ? 0 : bad);
      CHECK(std::abs(limiter.ceiling() - before) <= 3.3 / 16000 * 1.001);
      before = limiter.ceiling();
    }
    CHECK(before <= cut + 3.3 / 16000);
    limiter.step({0, 2, 0});
    CHECK(limiter.limit() == Limit::temperature);
    for (int k = 0; k < 16001; ++k) limiter.rest(0);
    CHECK(limiter.ceiling() == 3.3);
  }
}

TEST_CASE("a force whose square overflows is clamped correctly") {
  auto limiter = ramped();
  const Vector3d force = limiter.step({3e300, -4e300, 0});
  CHECK(force.norm() == doctest::Approx(3.3));
  CHECK(force.y() < 0);
}

TEST_CASE("an unknown time does not count as rest: wrong time stamps do not restore the budget") {
  ForceLimiter limiter({}, 1 / 1600.0);
  const double all = 4 * 0.25 * 0.88 * 0.88 * 10;  // N^2 s, more than the budget can hold
  limiter.set_spent(all);
  const double spent = limiter.budget().spent();
  for (int k = 0; k < 1000; ++k) limiter.rest(0, k % 2 == 0 ? -0.01 : std::numeric_limits<double>::quiet_NaN());
  CHECK(limiter.budget().spent() == spent);
  limiter.rest(0, 1);
  CHECK(limiter.budget().spent() < spent);
}

namespace {
/// The limits without the ramp, as plain formulas: each tick takes every root and division.
template <typename Scalar>
struct PlainLimits {
  explicit PlainLimits(const ForceLimits& limits)
      : given(limits),
        most(static_cast<Scalar>(limits.max_force)),
        budget(static_cast<Scalar>(limits.continuous_time), static_cast<Scalar>(limits.continuous_force)) {}

  Vector3<Scalar> step(const Vector3<Scalar>& wanted, Scalar temperature) {
    budget.spend(held.squaredNorm(), Scalar(T));
    const auto warm = static_cast<Scalar>(given.warm_motor);
    const Scalar target = temperature <= warm ? 1 : std::max(Scalar(0), (1 - temperature) / (1 - warm));
    factor = std::min(target, factor + Scalar(T) / static_cast<Scalar>(given.continuous_time));
    const Scalar steady = std::min(most, std::sqrt(budget.rate()));
    const Scalar share = std::min(Scalar(1), 2 * budget.left());
    const Scalar room = std::sqrt(budget.permitted_square(BasicForceLimiter<Scalar>::longest_hold, budget.spent()));
    ceiling = factor * std::min(steady + share * (most - steady), room);
    const Scalar norm = wanted.stableNorm();
    if (norm <= ceiling) {
      limit = Limit::none;
      return held = wanted;
    }
    limit = factor < 1 ? Limit::temperature : ceiling < most ? Limit::continuous : Limit::peak;
    ++(limit == Limit::temperature  ? counters.temperature
       : limit == Limit::continuous ? counters.continuous
                                    : counters.peak);
    return held = wanted / norm * ceiling;
  }

  ForceLimits given;
  Scalar most, ceiling = 0, factor = 1;
  BasicForceBudget<Scalar> budget;
  Vector3<Scalar> held{};
  Limit limit = Limit::none;
  LimitCounters counters{};
};

template <typename Scalar>
void compare_with_plain_limits(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1), side(-1, 1);
  ForceLimits limits{0.1 + 9 * part(random), 0.05 + 2 * part(random), 0.05 + 10 * part(random), T};
  BasicForceLimiter<Scalar> limiter(limits, Scalar(T));
  PlainLimits<Scalar> plain(limits);
  bool warm = false;
  const auto counters = [](const LimitCounters& c) { return std::array{c.peak, c.continuous, c.temperature, c.ramp}; };
  for (int k = 0; k < 4000; ++k) {
    if (k % 500 == 0) warm = part(random) < 0.3;
    const auto temperature = static_cast<Scalar>(warm ? part(random) : 0.5);
    const Vector3<Scalar> direction =
        Vector3d(side(random), side(random), side(random)).stableNormalized().cast<Scalar>();
    Vector3<Scalar> wanted = static_cast<Scalar>(limits.max_force * 1.2 * part(random)) * direction;
    if (k % 3 == 0) wanted = plain.ceiling * direction;  // next to the ceiling
    if (k % 97 == 0) wanted = static_cast<Scalar>(1e-30) * direction;
    const Vector3<Scalar> force = limiter.step(wanted, temperature);
    REQUIRE(force == plain.step(wanted, temperature));
    REQUIRE(limiter.ceiling() == plain.ceiling);
    REQUIRE(limiter.limit() == plain.limit);
    REQUIRE(limiter.budget().spent() == plain.budget.spent());
  }
  CHECK(counters(limiter.counters()) == counters(plain.counters));
}
}  // namespace

TEST_CASE("the force and the ceiling are those of the plain formulas, bit for bit" * doctest::test_suite("numbers")) {
  std::mt19937 random(11);
  for (int i = 0; i < cases(20); ++i) {
    compare_with_plain_limits<double>(random);
    compare_with_plain_limits<float>(random);
  }
}
