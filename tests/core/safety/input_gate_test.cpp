#include "punctura/safety/input_gate.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "../support/tick.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
DeviceSample sample(std::uint64_t k) { return {k, static_cast<double>(k) * T, {0, 1e-3, 0}, {0, -1, 0}, 0, true}; }

/// The result of a gate for a second sample, after a valid first sample.
Fault second(DeviceSample s, bool axis_is_used = true) {
  InputGate gate({}, T, axis_is_used);
  CHECK(gate.step(sample(0)) == Fault::none);
  return gate.step(s);
}
}  // namespace

TEST_CASE("valid samples pass the gate") {
  InputGate gate({}, T, true);
  for (std::uint64_t k = 0; k < 1000; ++k) REQUIRE(gate.step(sample(k)) == Fault::none);
}

TEST_CASE("a number that is not finite is refused in every field") {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (std::size_t i = 0; i < 3; ++i) {
      auto s = sample(1);
      s.position[i] = bad;
      CHECK(second(s) == Fault::non_finite_input);
      s = sample(1);
      s.axis[i] = bad;
      CHECK(second(s) == Fault::non_finite_input);
      CHECK(second(s, false) == Fault::none);  // an axis that is not used can have any value
    }
    for (double DeviceSample::* number :
         {&DeviceSample::time, &DeviceSample::motor_temperature, &DeviceSample::thumb_felt}) {
      auto s = sample(1);
      s.*number = bad;
      CHECK(second(s) == Fault::non_finite_input);
    }
    auto s = sample(1);
    s.thumb = bad;
    CHECK(second(s) == (std::isnan(bad) ? Fault::thumb : Fault::non_finite_input));
  }
}

TEST_CASE("a position or a thumb beyond 1000 km is refused, also in float") {
  for (double far : {2e6, -1e7, 1e30, 1e300}) {
    for (std::size_t i = 0; i < 3; ++i) {
      auto s = sample(0);
      s.position[i] = far;
      CHECK(InputGate({}, T, true).step(s) == Fault::non_finite_input);
      CHECK(InputGateF({}, T, true).step(s) == Fault::non_finite_input);
    }
    auto s = sample(0);
    s.thumb = far;
    CHECK(InputGate({}, T, true).step(s) == Fault::non_finite_input);
  }
  auto s = sample(0);
  s.position = {1e6, -1e6, 1e6};
  CHECK(InputGate({}, T, true).step(s) == Fault::none);
  CHECK(std::string(describe(Fault::non_finite_input)).find("1000 km") != std::string::npos);
}

TEST_CASE("an axis that does not have length 1 is refused") {
  auto s = sample(1);
  s.axis = {0, -1.01, 0};
  CHECK(second(s) == Fault::bad_axis);
  s.axis = {0, 0, 0};
  CHECK(second(s) == Fault::bad_axis);
  CHECK(second(s, false) == Fault::none);
  s.axis = {0, -1.0005, 0};
  CHECK(second(s) == Fault::none);
}

TEST_CASE("a position that moves faster than 8 m/s is refused, except in the first sample") {
  auto s = sample(1);
  s.position[1] += 5.1e-3;
  CHECK(second(s) == Fault::position_jump);
  s.position[1] = 1e-3 + 4.9e-3;
  CHECK(second(s) == Fault::none);
  InputGate gate({}, T, true);
  s.position[1] = 0.3;
  CHECK(gate.step(s) == Fault::none);
}

namespace {
/// The result for a hand that moves at a speed (m/s), with readings every `between` seconds.
Fault moving(double speed, double between, double period) {
  InputGate gate({}, period, true);
  Fault fault = Fault::none;
  for (std::uint64_t k = 0; k < 20 && fault == Fault::none; ++k) {
    auto s = sample(k);
    s.time = static_cast<double>(k) * between;
    s.position[0] = speed * s.time;
    fault = gate.step(s);
  }
  return fault;
}
}  // namespace

TEST_CASE("the gate checks speed, not distance: a slow device and a permitted gap are no jump") {
  CHECK(moving(1.5, 1 / 300.0, 1 / 300.0) == Fault::none);  // 5 mm from one reading to the next
  CHECK(moving(0.3, 0.019, T) == Fault::none);              // 5.7 mm in a gap that the deadline permits
  CHECK(moving(8.1, 1 / 300.0, 1 / 300.0) == Fault::position_jump);
  CHECK(moving(8.1, 0.019, T) == Fault::position_jump);
}

TEST_CASE("the time between two readings counts as at least one period") {
  auto s = sample(1);
  s.time = 1e-5;
  s.position[1] += 4.9e-3;
  CHECK(second(s) == Fault::none);
}

TEST_CASE("the speed of a new reading is computed from the time of the last new reading") {
  InputGate gate({}, T, true);
  CHECK(gate.step(sample(0)) == Fault::none);
  auto s = sample(0);
  for (int k = 1; k <= 10; ++k) {
    s.time = k * T;
    CHECK(gate.step(s) == Fault::none);
  }
  s.sequence = 1;
  s.time = 11 * T;
  s.position[1] += 0.040;  // 5.8 m/s over eleven periods
  CHECK(gate.step(s) == Fault::none);
}

TEST_CASE("the same reading for longer than 15 ms is stale") {
  InputGate gate({}, T, true);
  auto s = sample(0);
  int k = 0;
  Fault fault = Fault::none;
  for (; k < 1000 && fault == Fault::none; ++k) {
    s.time = k * T;
    fault = gate.step(s);
  }
  CHECK(fault == Fault::stale_sample);
  CHECK((k - 1) * T == doctest::Approx(0.015).epsilon(0.05));
}

TEST_CASE("a tick more than 20 ms after the last is a missed deadline") {
  auto s = sample(1);
  s.time = 0.0201;
  CHECK(second(s) == Fault::missed_deadline);
  s.time = 0.0199;
  CHECK(second(s) == Fault::none);
}

TEST_CASE("a clock that goes back is refused") {
  auto s = sample(1);
  s.time = -1e-6;
  CHECK(second(s) == Fault::clock);
}

TEST_CASE("a fault that the back-end reports is a fault of the gate") {
  auto s = sample(1);
  s.healthy = false;
  CHECK(second(s) == Fault::device);
}

TEST_CASE("after a reset the first sample is checked without history") {
  InputGate gate({}, T, true);
  gate.step(sample(0));
  gate.state = {};
  auto s = sample(100000);
  s.position[0] = 0.2;
  CHECK(gate.step(s) == Fault::none);
}

TEST_CASE("each fault has its own description") {
  for (int i = 1; i <= static_cast<int>(Fault::device); ++i) {
    CHECK(std::string(describe(static_cast<Fault>(i))).size() > 20);
    for (int j = 0; j < i; ++j) CHECK(std::string(describe(static_cast<Fault>(i))) != describe(static_cast<Fault>(j)));
  }
}
