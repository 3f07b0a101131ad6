#include "punctura_runtime/backends/registry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace punctura;

TEST_CASE("every back-end is listed once, with its state in words; the simulated one is always there") {
  const auto all = enumerate_devices();
  for (const auto& status : all) {
    CAPTURE(status.backend);
    CHECK_FALSE(status.detail.empty());
    CHECK(std::count_if(all.begin(), all.end(), [&](const auto& s) { return s.backend == status.backend; }) == 1);
  }
  REQUIRE_FALSE(all.empty());
  CHECK(all.back().backend == "simulated");
  CHECK(all.back().state == BackendStatus::State::available);
}

TEST_CASE("a back-end is opened by its name, at the rate asked for where it can") {
  CHECK(open_device("simulated", {1000, "", ""})->info().rate == 1000);
}

TEST_CASE("a name that no back-end has, and a rate that cannot be, are told") {
  CHECK_THROWS_WITH_AS(open_device("abacus"), doctest::Contains("simulated"), DeviceError);
  CHECK_THROWS_AS(open_device("simulated", {0, "", ""}), DeviceError);
  CHECK_THROWS_AS(open_device("simulated", {unknown, "", ""}), DeviceError);
}
