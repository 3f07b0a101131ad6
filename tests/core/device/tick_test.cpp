#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "punctura/device/device.hpp"

using namespace punctura;

namespace {
/// What a device gets from a loop that computes this force. max_force: N
Tick::Force given(Tick::Force computed, double max_force = 5) {
  const Tick tick{[](void* force, const DeviceSample&) noexcept { return *static_cast<Tick::Force*>(force); },
                  &computed, max_force};
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
      CHECK(given(computed, infinite) == Tick::Force{0, 0, 0});
    }
}

TEST_CASE("no device gets a force above the limit; the direction stays, and a smaller force to the bit") {
  CHECK(given({30, 40, 0})[0] == doctest::Approx(3));
  CHECK(given({30, 40, 0})[1] == doctest::Approx(4));
  CHECK(given({0, -1e300, 1e300})[1] == doctest::Approx(-5 / std::sqrt(2.0)));
  CHECK(given({0.1, -1e-310, 4.9}) == Tick::Force{0.1, -1e-310, 4.9});
  CHECK(given({3, 4, 0}) == Tick::Force{3, 4, 0});
}

TEST_CASE("a limit that is NaN or negative lets no force through") {
  for (double limit : {std::numeric_limits<double>::quiet_NaN(), -5.0, -0.1})
    for (double newtons : {0.1, 4.0, 10.0}) CHECK(given({newtons, 0, 0}, limit) == Tick::Force{0, 0, 0});
  CHECK(given({0, 2, 0}, 0) == Tick::Force{0, 0, 0});
}
