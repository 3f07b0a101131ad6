#include "punctura/signal/low_pass.hpp"

#include <doctest/doctest.h>

#include "punctura/model/vector3.hpp"

using namespace punctura;

TEST_CASE("the gain of K06's filter is that of a zero-order hold") {
  CHECK(LowPass<double>(300, 1 / 1600.0).gain() == doctest::Approx(0.6921).epsilon(1e-4));
}

TEST_CASE("the low-pass starts at the first sample") {
  LowPass<double> filter(300, 1 / 1600.0);
  CHECK(filter.step(0.25) == 0.25);
  CHECK(filter.step(0.25) == 0.25);
  filter.state = {};
  CHECK(filter.step(-1) == -1);
}

TEST_CASE("the step response has no overshoot and equals that of the continuous filter") {
  const double f = 300, T = 1 / 1600.0;
  LowPass<double> filter(f, T);
  filter.step(0);
  for (int k = 1; k <= 20; ++k)
    CHECK(filter.step(1) == doctest::Approx(1 - std::exp(-2 * std::numbers::pi * f * T * k)).epsilon(1e-12));
}

TEST_CASE("a cutoff of 0 Hz leaves samples unchanged, bit for bit") {
  LowPass<double, Vector3d> filter(0, 1 / 1600.0);
  for (double x : {0.1, -3.7e-5, 1e9, 0.3}) CHECK(filter.step({x, 2 * x, 3 * x}) == Vector3d(x, 2 * x, 3 * x));
  CHECK(LowPass<double>(0, 1).gain() == 1);
}
