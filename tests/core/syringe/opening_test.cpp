// The layers beside a needle's opening, as one outlet.
#include "punctura/syringe/syringe.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace punctura;

namespace {
constexpr double X = 3e-3;
using Layer = LayerAtTip<double>;

Outlet open_at(double depth) {
  const std::array<Layer, 2> layers{
      Layer{depth, 4e-3, {1e13, 8000}, {1e10, 1000}},
      Layer{depth - 8e-3, 1e-3, {1e12, 5000}, {1e9, 2000}},
  };
  return outlet_at(std::span<const Layer>(layers), X);
}
}  // namespace

TEST_CASE("an opening that lies in one layer has this layer's outlet") {
  CHECK(open_at(-1e-3).resistance < 1e7);
  CHECK(open_at(3.5e-3).resistance == doctest::Approx(1e13));
  CHECK(open_at(3.5e-3).pressure == doctest::Approx(8000));
  CHECK(open_at(7.5e-3).resistance == doctest::Approx(1e10));
  CHECK(open_at(7.5e-3).pressure == doctest::Approx(1000));
  CHECK(open_at(20e-3).resistance == doctest::Approx(1e9));
  CHECK(open_at(20e-3).pressure == doctest::Approx(2000));
}

TEST_CASE("between two layers the flow is the sum of the flows through the two parts of the opening") {
  const Outlet half = open_at(4e-3 + X / 2);  // half of the opening is behind the first layer
  for (const double P : {0.0, 3000.0, 20000.0}) {
    const double flow = 0.5 * (P - 8000) / 1e13 + 0.5 * (P - 1000) / 1e10;
    CHECK((P - half.pressure) / half.resistance == doctest::Approx(flow));
  }
}

TEST_CASE("the resistance falls steadily while the opening passes the far face") {
  double before = open_at(4e-3).resistance;
  for (double depth = 4.01e-3; depth < 7e-3; depth += 1e-5) {
    const double now = open_at(depth).resistance;
    REQUIRE(now < before);
    before = now;
  }
  CHECK(before == doctest::Approx(1e10).epsilon(0.01));
}

TEST_CASE("a membrane that the needle did not enter through its front changes nothing") {
  const std::array<Layer, 2> barred{Layer{0, 4e-3, {1e13, 8000}, {1e10, 1000}},
                                    Layer{5e-3, 1e-3, {1e12, 5000}, {1e9, 2000}}};
  const Outlet outlet = outlet_at(std::span<const Layer>(barred), X);
  CHECK(outlet.resistance < 1e7);  // in front of the first membrane means in open air
}
