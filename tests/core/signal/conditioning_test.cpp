#include "punctura/signal/conditioning.hpp"

#include <doctest/doctest.h>

#include <utility>

#include "../support/allocations.hpp"
#include "../support/encoder.hpp"
#include "../support/tick.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// The conditioned position of a motion along y.
class Conditioned {
 public:
  explicit Conditioned(Conditioning how, double step = count) : filter_(how, 300, step, T) {}
  double operator()(double y) { return filter_.step({0, y, 0})[1]; }

 private:
  PositionConditioner<double> filter_;
};

/// The mean lag behind a steady motion with an encoder, s, over 16 phases of the encoder grid.
double lag(Conditioning how, double speed) {
  double sum = 0;
  int n = 0;
  for (int phase = 0; phase < 16; ++phase) {
    Conditioned filter(how);
    for (int k = 0; k < 3200; ++k) {
      const double x = speed * T * k, y = filter(encoder(x, phase / 16.0));
      if (k < 800) continue;
      sum += (x - y) / speed;
      ++n;
    }
  }
  return sum / n;
}

}  // namespace

TEST_CASE("the encoder step does not change K06's filter, bit for bit") {
  PositionConditioner<double> filter(Conditioning::low_pass, 300, count, T);
  LowPass<double, Vector3d> alone(300, T);
  for (int k = 0; k < 500; ++k) {
    const Vector3d p(std::sin(0.1 * k), encoder(1e-3 * std::sin(0.03 * k)), k);
    CHECK(filter.step(p) == alone.step(p));
  }
}

TEST_CASE("for an ideal sensor the conditioning with line fit leaves samples unchanged") {
  PositionConditioner<double> filter(Conditioning::line_fit, 300, 0, T);
  for (int k = 0; k < 50; ++k)
    CHECK(filter.step({0.1 * k, -1.0 * k, 1.0 / (k + 1)}) == Vector3d(0.1 * k, -1.0 * k, 1.0 / (k + 1)));
}

TEST_CASE("at 10 mm/s the line fit adds less than 1 ms to K06's filter; a motion lags by half of the play") {
  CHECK(lag(Conditioning::low_pass, 10e-3) == doctest::Approx(0.278e-3).epsilon(0.1));
  CHECK(lag(Conditioning::line_fit, 10e-3) - lag(Conditioning::low_pass, 10e-3) < 0.9e-3);
  for (const double speed : {5e-3, 10e-3, 20e-3, 100e-3})
    CHECK(lag(Conditioning::line_fit, speed) * speed == doctest::Approx(0.2 * count).epsilon(0.1));
}

TEST_CASE("a finer encoder gets less smoothing and the force noise stays the same") {
  double window = 0;
  for (const double step : {1e-6, 5e-6, 1e-5, 2e-5, 3e-5, count}) {
    PositionConditioner<double> filter(Conditioning::line_fit, 300, step, T);
    Noise noise(5);
    double y = 0, f = 0, square = 0;
    for (int k = 0; k < 20000; ++k) {  // n-1, n or n+1 at random; the force of K06's coupling if the proxy sticks
      const double y_now = filter.step({0, (std::floor(3 * noise.uniform()) - 1) * step, 0})[1];
      const double f_now = -400 * y_now - (y_now - y) / T;
      if (k >= 100) square += (f_now - f) * (f_now - f) / 19900;
      y = y_now, f = f_now;
    }
    CHECK(std::sqrt(square) < 0.0065);
    CHECK(Smoothing<double>::of(step).window > window);
    window = Smoothing<double>::of(step).window;
  }
  CHECK(window == doctest::Approx(0.015));
  CHECK(Smoothing<double>::of(1e-3).window == doctest::Approx(0.015));
}

TEST_CASE("a reversal has a dead band of 0.4 counts, the play") {
  Conditioned filter(Conditioning::line_fit);
  double width = 0;
  int n = 0;
  for (int k = 0; k < 12800; ++k) {  // 1 mm in and out at 1 mm/s
    const int place = k % 3200, way = place < 1600 ? 1 : -1;
    const double x = 1e-3 * T * (way > 0 ? place : 3200 - place), y = filter(encoder(x, 0.3));
    CHECK(std::abs(y - x) < count);
    if (k < 3200 || place % 1600 < 48) continue;
    width += 2 * way * (x - y);
    ++n;
  }
  CHECK(width / n == doctest::Approx(0.4 * count).epsilon(0.1));
}

TEST_CASE("an axis at rest stays at rest while another axis moves") {
  PositionConditioner<double> filter(Conditioning::line_fit, 300, count, T);
  for (int k = 0; k < 500; ++k) {
    const Vector3d p = filter.step({0.02, encoder(2e-5 * k), -0.01});
    CHECK(p[0] == 0.02);
    CHECK(p[2] == -0.01);
  }
}

TEST_CASE("after a sudden stop the position settles within 20 ms, inside the play") {
  for (const double speed : {10e-3, 0.2}) {
    Conditioned filter(Conditioning::line_fit);
    double x = 0, worst = 0;
    for (int k = 0; k < 400; ++k) filter(encoder(x = speed * T * k, 0.3));
    const double end = encoder(x, 0.3);
    for (int k = 1; k < 200; ++k) {
      const double off = std::abs(filter(end) - end);
      worst = std::max(worst, off);
      if (k >= 32) CHECK(off < 0.21 * count);
    }
    CHECK(worst < 3 * count);
  }
}

TEST_CASE("the position has no jump when the conditioning changes") {
  for (const auto& [from, to] : {std::pair{Conditioning::low_pass, Conditioning::line_fit},
                                 {Conditioning::line_fit, Conditioning::low_pass},
                                 {Conditioning::line_fit, Conditioning::line_fit}}) {
    PositionConditioner<double> first(from, 300, count, T), second(to, 300, count / 2, T);
    double y = 0;
    for (int k = 0; k < 200; ++k) y = first.step({0, encoder(10e-3 * T * k), 0})[1];
    second.resume(first);
    for (int k = 200; k < 260; ++k) {
      const double y_prev = y;
      y = second.step({0, encoder(10e-3 * T * k), 0})[1];
      CHECK(std::abs(y - y_prev) < 0.75 * count);  // K06's filter changes a step of one count to 0.69 counts
    }
  }
}

TEST_CASE("a line with a window of another size starts without samples") {
  PositionConditioner<double> first(Conditioning::line_fit, 0, count, T),
      other(Conditioning::line_fit, 0, count, T / 2);
  for (int k = 0; k < 200; ++k) first.step({1, 1, 1});
  other.resume(first);
  for (int k = 0; k < 200; ++k) CHECK(std::abs(other.step({1, 1, 1})[1] - 1) <= count / 2);
}

TEST_CASE("conditioning allocates no memory after its construction") {
  PositionConditioner<double> filter(Conditioning::line_fit, 300, count, T), other = filter;
  const std::size_t before = allocations();
  for (int k = 0; k < 100; ++k) filter.step({encoder(1e-5 * k), 0, encoder(-1e-3 * k)});
  other.resume(filter);
  other.step({1, 2, 3});
  other.reset();
  other.step({1, 2, 3});
  CHECK(allocations() == before);
}

static_assert(noexcept(std::declval<PositionConditioner<double>&>().step(std::declval<const Vector3d&>())));
