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

// The first numbers that others' SplitMix64 gives for the seed 0.
static_assert(split_mix(0, 1) == 0xe220a8397b1dcdaf && split_mix(0, 2) == 0x6e789e6aa1b965f4);
static_assert(TickNoise(1).from(5).at(2) == TickNoise(1).at(7) && !(TickNoise(1).at(2) == TickNoise(2).at(1)));

TEST_CASE("the noise of ticks is uniform, and ticks, axes and seeds are independent") {
  constexpr int n = 40000;
  Vector3d sum, squares;
  double next = 0, across = 0, seeds = 0;
  for (std::uint64_t k = 0; k < n; ++k) {
    const Vector3d u = TickNoise(7).at(k);
    sum += u;
    squares += Vector3d(u.x() * u.x(), u.y() * u.y(), u.z() * u.z());
    next += u.x() * TickNoise(7).at(k + 1).x();
    across += u.x() * u.y();
    seeds += u.x() * TickNoise(8).at(k).x();
  }
  for (std::size_t j = 0; j < 3; ++j) {
    CHECK(std::abs(sum[j] / n) < 4 * std::sqrt(1. / 12 / n));
    CHECK(std::abs(squares[j] / n - 1. / 12) < 4 * std::sqrt(1. / 180 / n));
  }
  for (const double product : {next, across, seeds}) CHECK(std::abs(product / n) < 4. / 12 / std::sqrt(n));
}
