#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "punctura/device/device.hpp"

using namespace punctura;

namespace {
/// What a device gets from a loop that computes this force, with a limit of 5 N.
Tick::Force given(Tick::Force computed) {
  const Tick tick{[](void* force, const DeviceSample&) noexcept { return *static_cast<Tick::Force*>(force); },
                  &computed, 5};
  return tick({});
}
}  // namespace

TEST_CASE("no device gets a force that is not finite") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (double bad : {nan, infinite, -infinite})
    for (std::size_t i = 0; i < 3; ++i) {
      Tick::Force computed{1, 2, 3};
      computed[i] = bad;
      CHECK(given(computed) == Tick::Force{0, 0, 0});
    }
}

TEST_CASE("no device gets a force above the limit; the direction stays, and a smaller force to the bit") {
  CHECK(given({30, 40, 0})[0] == doctest::Approx(3));
  CHECK(given({30, 40, 0})[1] == doctest::Approx(4));
  CHECK(given({0, -1e300, 1e300})[1] == doctest::Approx(-5 / std::sqrt(2.0)));
  CHECK(given({0.1, -1e-310, 4.9}) == Tick::Force{0.1, -1e-310, 4.9});
  CHECK(given({3, 4, 0}) == Tick::Force{3, 4, 0});
}
