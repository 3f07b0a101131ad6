#include "punctura/lab/plant/noise.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace punctura;

TEST_CASE("a normal number is that of Box and Muller to a few units in the last place") {
  Noise noise(1);
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = i == 0 ? 0 : i == 1 ? 1 - 0x1p-53 : noise.uniform(), v = i < 5 ? 0.25 * (i % 4) : noise.uniform();
    const double radius = std::sqrt(-2 * std::log(1 - u));
    largest = std::max(largest, std::abs(unit_normal(u, v) - radius * std::cos(2 * std::numbers::pi * v)));
  }
  CHECK(largest < 5e-15);  // of up to 8.6
}

TEST_CASE("the numbers of a seed have these bits on every machine") {
  Noise noise(42);
  CHECK(noise.uniform() == 0x1.82a3befaddcbcp-1);
  CHECK(noise.normal() == 0x1.3b3ee1b0cccffp-6);
  CHECK(noise.normal() == 0x1.c705420f42314p-2);
  CHECK(unit_normal(0.0, 0.75) == 0);
}

TEST_CASE("normal numbers have mean 0 and variance 1") {
  Noise noise(5);
  double sum = 0, squares = 0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    const double x = noise.normal();
    sum += x;
    squares += x * x;
  }
  CHECK(std::abs(sum / n) < 4 / std::sqrt(n));
  CHECK(std::abs(squares / n - 1) < 4 * std::sqrt(2.0 / n));
}
