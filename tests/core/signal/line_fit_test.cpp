#include "punctura/signal/line_fit.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "../support/encoder.hpp"
#include "../support/tick.hpp"

using namespace punctura;
using namespace punctura::test;
using test::count, test::encoder;

namespace {
constexpr double window = 0.015;
}

TEST_CASE("the line fit follows a steady motion of any speed without lag") {
  for (const double speed : {1e-4, 1e-2, 1.0}) {
    LineFit<double> fit(count, window, T);
    for (int k = 0; k < 100; ++k) {
      const double x = 0.1 + speed * T * k, y = fit.step(x);
      if (k >= 24) CHECK(y == doctest::Approx(x).epsilon(1e-12));
    }
  }
}

TEST_CASE("with a lead the line is extrapolated beyond the newest sample") {
  LineFit<double> fit(count, window, T, 1.25);
  for (int k = 0; k < 100; ++k) {
    const double y = fit.step(1e-5 * k);
    if (k >= 24) CHECK(y == doctest::Approx(1e-5 * (k + 1.25)).epsilon(1e-12));
  }
}

TEST_CASE("the line fit returns the position of a device at rest, bit for bit") {
  LineFit<double> fit(count, window, T, 1.25);
  for (int k = 0; k < 100; ++k) CHECK(fit.step(-0.0123456789) == -0.0123456789);
}

TEST_CASE("the running sums give the line of a fit over all samples, also far from the origin and after many ticks") {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  LineFit<double> fit(count, window, T);
  const std::size_t n = fit.size();
  std::vector<double> x(n, 0.3);
  double worst = 0;
  for (int k = 0; k < 100000; ++k) {
    x.insert(x.begin(), 0.3 + 2e-3 * std::sin(1e-3 * k) + count * any(random));
    x.resize(n);
    const double y = fit.step(x[0]);
    if (k % 97 != 0 || k < 30) continue;
    double sum = 0, moment = 0;
    for (std::size_t i = 0; i < n; ++i) sum += x[i] - x[0], moment += (static_cast<double>(i) - 12) * (x[i] - x[0]);
    const double right = x[0] + sum / 25 - 12 * moment * 12 / (25.0 * 624);
    worst = std::max(worst, std::abs(y - right));
  }
  CHECK(worst < 1e-14);
}

TEST_CASE("the window starts with copies of the first sample, also after a reset") {
  LineFit<double> fit(count, window, T, 1.25), fresh(count, window, T, 1.25);
  for (int k = 0; k < 30; ++k) fit.step(0.1 * k);
  fit.reset();
  for (int k = 0; k < 40; ++k) CHECK(fit.step(1 + 1e-5 * k) == fresh.step(1 + 1e-5 * k));
}

TEST_CASE("a fit with the state of another one has its samples, and its own tolerance and lead") {
  LineFit<double> first(count, window, T), second(2 * count, window, T, 1.25), whole(2 * count, window, T, 1.25);
  for (int k = 0; k < 30; ++k) first.step(1e-5 * k), whole.step(1e-5 * k);
  second.state = first.state;
  for (int k = 30; k < 60; ++k) CHECK(second.step(1e-5 * k) == whole.step(1e-5 * k));
}

TEST_CASE("the line fit leaves the samples of an ideal sensor unchanged") {
  LineFit<double> fit(0, window, T, 1.25);
  for (const double x : {0.1, -3.7e-5, 1e9, 0.3}) CHECK(fit.step(x) == x);
}

TEST_CASE("the end of the line is at most two counts from the newest sample") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const double rough : {0.5, 3.0, 50.0}) {
    LineFit<double> fit(count, window, T);
    double x = 0, speed = 0;
    for (int k = 0; k < 4000; ++k) {
      speed = 0.98 * speed + rough * count * 0.2 * any(random);
      x += speed + rough * count * any(random) * (k % 50 == 0);
      CHECK(std::abs(fit.step(x) - x) <= 2 * count * (1 + 1e-12));
    }
  }
}

TEST_CASE("the line fit follows a jump and a stop in the same tick") {
  LineFit<double> fit(count, window, T);
  for (int k = 0; k < 40; ++k) fit.step(0);
  CHECK(fit.step(5e-3) == 5e-3);
  for (int k = 0; k < 40; ++k) fit.step(5e-3 + 0.5 * T * k);
  const double end = 5e-3 + 0.5 * T * 39;
  for (int k = 0; k < 4; ++k) CHECK(std::abs(fit.step(end) - end) <= 2 * count);
}

TEST_CASE("the window has an odd number of samples, from 3 to 129") {
  const auto size = [](double rate, double seconds = window) {
    return LineFit<double>(count, seconds, 1 / rate).size();
  };
  CHECK(size(1600) == 25);
  CHECK(size(1000) == 17);
  CHECK(size(4000) == 61);
  CHECK(size(100) == 3);
  CHECK(size(1e5) == 129);
  CHECK(size(1600, 0) == 3);
  for (double rate = 100; rate < 2e4; rate += 7) CHECK(size(rate) % 2 == 1);
}

TEST_CASE("an encoder that toggles moves the end of the line by 1/n of its step") {
  LineFit<double> fit(count, window, T);
  double y = 0;
  for (int k = 0; k < 60; ++k) {
    const double y_prev = y;
    y = fit.step(k % 2 * count);
    if (k > 26) CHECK(std::abs(y - y_prev) == doctest::Approx(count / 25).epsilon(1e-9));
  }
}

TEST_CASE("float and double fit the same line within the precision of float, also far from the origin") {
  LineFit<double> exact(count, window, T, 1.25);
  LineFit<float> rounded(static_cast<float>(count), static_cast<float>(window), static_cast<float>(T), 1.25f);
  for (int k = 0; k < 400; ++k) {
    const double x = encoder(0.4 + 3e-3 * std::sin(0.05 * k));
    const double seen = static_cast<float>(x);  // both get the value in float, otherwise the windows could differ
    CHECK(rounded.step(static_cast<float>(seen)) == doctest::Approx(exact.step(seen)).epsilon(1e-6));
  }
}

static_assert(noexcept(std::declval<LineFit<double>&>().step(0.0)) &&
              noexcept(std::declval<LineFit<double>&>().reset()));
