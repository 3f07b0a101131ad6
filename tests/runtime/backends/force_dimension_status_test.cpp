// The registry's entry for Force Dimension devices in each possible state.
#include <doctest/doctest.h>

#include <algorithm>

#include "fakes/drd/rig.hpp"
#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"
#include "punctura_runtime/backends/registry.hpp"
#include "runtime/support/environment.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

using BackendState = BackendStatus::State;

struct Override : Environment {
  explicit Override(const char* library) : Environment("PUNCTURA_DRD_LIBRARY", library) {}
};

BackendStatus status() {
  for (auto& one : enumerate_devices())
    if (one.backend == "force_dimension") return one;
  FAIL("the registry does not know of Force Dimension");
  return {};
}

BackendStatus drd_status(const fake_drd::Settings& settings) {
  const Override library(PUNCTURA_FAKE_DRD);
  fake().reset(&settings);
  return status();
}

bool status_says(const BackendStatus& status, const std::string& words) {
  return status.detail.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a missing library is reported with all searched places and what to do") {
  const Override library("/nowhere/libdrd.so.3");
  const auto missing = status();
  CHECK(missing.state == BackendState::library_not_found);
  CHECK(status_says(missing, "/nowhere/libdrd.so.3"));
  CHECK(status_says(missing, "PUNCTURA_DRD_LIBRARY"));
}

TEST_CASE("without an override, the library is searched in the SDK, then elsewhere, the robotics library first") {
  const Environment sdk("FDSDK", "/opt/sdk-of-nobody");
  const auto names = force_dimension::candidates();
  CHECK(force_dimension::searched_folders().front().find("sdk-of-nobody") != std::string::npos);
  const auto first = [&](const char* what) {
    return std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.find(what) != std::string::npos; });
  };
  CHECK(first("drd") < first("dhd"));
  CHECK(first("dhd") != names.end());
}

TEST_CASE("the missing functions of a library are named") {
  const Override library(PUNCTURA_FAKE_DRD_OLD);
  const auto old = status();
  CHECK(old.state == BackendState::symbol_missing);
  CHECK(status_says(old, "dhdGetButtonMask, dhdSetForceAndTorqueAndGripperForce"));
  CHECK(status_says(old, PUNCTURA_FAKE_DRD_OLD));
  CHECK_THROWS_WITH_AS(open_device("force_dimension"), doctest::Contains("dhdGetButtonMask"), DeviceError);
}

TEST_CASE("the states: no device, in use by another program, needs calibration, available") {
  fake_drd::Settings settings;
  settings.devices = 0;
  const auto none = drd_status(settings);
  CHECK(none.state == BackendState::no_device);
  CHECK(status_says(none, "udev"));

  settings.devices = 1;
  settings.in_use = 1;
  const auto taken = drd_status(settings);
  CHECK(taken.state == BackendState::in_use);
  CHECK(status_says(taken, "Another program"));

  settings.in_use = 0;
  settings.calibrated = 0;
  const auto lost = drd_status(settings);
  CHECK(lost.state == BackendState::needs_calibration);
  CHECK(status_says(lost, "calibration pit"));
  CHECK(lost.devices == std::vector<std::string>{"omega.3 12345"});

  settings.calibrated = 1;
  const auto there = drd_status(settings);
  CHECK(there.state == BackendState::available);
  CHECK(there.devices == std::vector<std::string>{"omega.3 12345"});
  CHECK(status_says(there, PUNCTURA_FAKE_DRD));
  CHECK(fake().state().open == 0);
  CHECK(fake().state().writes == 0);
  CHECK(fake().state().force_on == 0);
}

TEST_CASE("a device that this program uses is listed as such, and listing does not close it") {
  const Override library(PUNCTURA_FAKE_DRD);
  fake_drd::Settings settings;
  fake().reset(&settings);
  const auto device = open_device("force_dimension", {2000, "omega.3 12345", ""});
  CHECK(device->info().rate == 2000);
  const auto taken = status();
  CHECK(taken.state == BackendState::in_use);
  CHECK(status_says(taken, "This program"));
  CHECK(fake().state().open == 1);
  CHECK_THROWS_AS(open_device("force_dimension"), DeviceError);
}

TEST_CASE("while one device is open, others can be listed, and the first stays open") {
  const Override library(PUNCTURA_FAKE_DRD);
  fake_drd::Settings settings;
  settings.devices = 2;
  fake().reset(&settings);
  const auto device = open_device("force_dimension");
  CHECK(status().state == BackendState::in_use);
  CHECK(fake().state().open == 1);
  CHECK_THROWS_WITH_AS(open_device("force_dimension"), doctest::Contains("open in this program"), DeviceError);
  CHECK(fake().state().open == 1);
}

TEST_CASE("a device is chosen by label, model or serial number; an unknown name gets the list of devices") {
  const Override library(PUNCTURA_FAKE_DRD);
  fake_drd::Settings settings;
  fake().reset(&settings);
  for (const char* name : {"", "omega.3 12345", "omega.3", "12345"})
    CHECK(open_device("force_dimension", {1600, name, ""})->info().serial == "12345");
  CHECK_THROWS_WITH_AS(open_device("force_dimension", {1600, "sigma.7", ""}), doctest::Contains("omega.3 12345"),
                       DeviceError);
}

TEST_CASE("an uncalibrated device is refused with advice; it moves by itself only on request") {
  fake_drd::Settings settings;
  settings.calibrated = 0;
  fake().reset(&settings);
  force_dimension::Options options;
  options.library = PUNCTURA_FAKE_DRD;
  CHECK_THROWS_WITH_AS(force_dimension::ForceDimensionDevice{options}, doctest::Contains("calibration pit"),
                       DeviceError);
  CHECK(fake().state().calibrations == 0);
  CHECK(fake().state().open == 0);

  options.auto_init = true;
  const force_dimension::ForceDimensionDevice device(options);
  CHECK(fake().state().calibrations == 1);
  CHECK(device.info().model == "omega.3");
}

TEST_CASE("the haptics library alone is enough, except for automatic calibration") {
  FakeDrd dhd(PUNCTURA_FAKE_DHD);
  fake_drd::Settings settings;
  dhd.reset(&settings);
  force_dimension::Options options;
  options.library = PUNCTURA_FAKE_DHD;
  CHECK(force_dimension::ForceDimensionDevice(options).info().model == "omega.3");
  settings.calibrated = 0;
  dhd.reset(&settings);
  options.auto_init = true;
  CHECK_THROWS_WITH_AS(force_dimension::ForceDimensionDevice{options}, doctest::Contains("libdrd"), DeviceError);
}
