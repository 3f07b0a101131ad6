#include "punctura_runtime/backends/registry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "punctura_runtime/backends/fed.hpp"

using namespace punctura;

TEST_CASE("every back-end is listed once with its state; the simulated one is always available") {
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

TEST_CASE("a back-end opens by its name, at the requested rate if possible") {
  CHECK(open_device("simulated", {1000, "", ""})->info().rate == 1000);
}

TEST_CASE("an unknown back-end and an invalid rate are reported") {
  CHECK_THROWS_WITH_AS(open_device("abacus"), doctest::Contains("simulated"), DeviceError);
  CHECK_THROWS_AS(open_device("simulated", {0, "", ""}), DeviceError);
  CHECK_THROWS_AS(open_device("simulated", {not_given, "", ""}), DeviceError);
}

namespace {
BackendStatus mine_status() { return {"mine", BackendStatus::State::available, "It is here.", {"mine 1"}}; }
std::shared_ptr<Device> open_mine(const OpenOptions& how) {
  DeviceInfo info;
  info.rate = how.rate;
  info.model = "mine: " + how.device;
  return std::make_shared<FedDevice>(info);
}
const Backend mine{"mine", mine_status, open_mine};
const Backend another_simulated{"simulated", mine_status, open_mine};
}  // namespace

TEST_CASE("a registered back-end is listed first and opens by its name; each name is listed once") {
  const std::size_t before = enumerate_devices().size();
  register_backend(mine);
  const auto all = enumerate_devices();
  CHECK(all.size() == before + 1);
  CHECK(all.front().backend == "mine");
  CHECK(open_device("mine", {1000, "two", ""})->info().model == "mine: two");
  CHECK_THROWS_AS(register_backend(mine), DeviceError);
  CHECK_THROWS_AS(register_backend(another_simulated), DeviceError);
  CHECK(enumerate_devices().size() == before + 1);
}
