// Finding, opening and describing an HD device.
#include "punctura_runtime/backends/openhaptics/openhaptics.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include "core/support/paper_scene.hpp"
#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "punctura_runtime/os/os.hpp"
#include "runtime/support/environment.hpp"
#include "runtime/support/fake_hd.hpp"
#include "runtime/support/patient.hpp"

using namespace punctura;
using namespace punctura::test;
using BackendState = BackendStatus::State;

namespace {

template <typename Change>
BackendStatus hd_status(Change&& change) {
  const Environment library("PUNCTURA_HD_LIBRARY", FAKE_HD);
  reset_fake_hd(change);
  const BackendStatus status = backends::openhaptics.status();
  CHECK(fake_hd().devices_open() == 0);
  CHECK(fake_hd().misuses() == 0);
  return status;
}

std::string hd_refusal(const OpenHapticsOptions& options) {
  try {
    OpenHapticsDevice device(options);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

/// A file that is not a library.
struct NoLibrary {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("punctura-no-library-" + std::to_string(os::now_ns()));

  NoLibrary() { std::ofstream(path) << "this is no library\n"; }
  ~NoLibrary() { std::filesystem::remove(path); }
};

std::string all_statements(const Device& device) {
  std::string all;
  for (const auto& line : device.statements()) all += line + "\n";
  return all;
}

}  // namespace

TEST_CASE("each state of the back-end has a message") {
  const auto available = hd_status([](auto&) {});
  CHECK(available.state == BackendState::available);
  CHECK(says(available.detail, "Simulated Omni, serial number F-0001"));
  CHECK(available.devices == std::vector<std::string>{"Default Device"});

  const auto none = hd_status([](auto& s) {
    s.name = "Left";
    s.null_opens = 0;
  });
  CHECK(none.state == BackendState::no_device);
  CHECK(says(none.detail, "The default device, \"Default Device\", \"Default PHANToM\" gave BAD_HANDLE"));

  const auto used = hd_status([](auto& s) { s.init_error = 0x301; });
  CHECK(used.state == BackendState::in_use);
  CHECK(says(used.detail, "other program"));

  const auto licence = hd_status([](auto& s) { s.init_error = 0x600; });
  CHECK(licence.state == BackendState::fault);
  CHECK(says(licence.detail, "licence"));

  const auto uncalibrated = hd_status([](auto& s) { s.calibration = 0x5002; });
  CHECK(uncalibrated.state == BackendState::needs_calibration);
  CHECK(says(uncalibrated.detail, "inkwell"));
}

TEST_CASE("a missing library is reported with all searched places") {
  const auto status = backends::openhaptics.status();
  if (status.state == BackendState::library_not_found)  // on a machine with OpenHaptics it is something else
    for (const auto& place : hd::usual_places()) CHECK(says(status.detail, place.c_str()));

  const Environment named("PUNCTURA_HD_LIBRARY", "/nowhere/libHD.so");
  const auto nowhere = backends::openhaptics.status();
  CHECK(nowhere.state == BackendState::library_not_found);
  CHECK(says(nowhere.detail, "/nowhere/libHD.so"));
}

TEST_CASE("a file that is not a library is reported with the reason") {
  const NoLibrary file;
  const auto loaded = hd::load(file.path.string().c_str());
  CHECK(loaded.state == BackendState::library_not_found);
  CHECK(says(loaded.detail, "does not load"));
}

TEST_CASE("all missing functions of the library are named") {
  const Environment library("PUNCTURA_HD_LIBRARY", FAKE_HD_INCOMPLETE);
  const auto status = backends::openhaptics.status();
  CHECK(status.state == BackendState::symbol_missing);
  CHECK(says(status.detail, "hdGetString, hdUpdateCalibration"));
}

TEST_CASE("the default device opens under each usual name, another device only under its own name") {
  for (const char* name : {"Default Device", "Default PHANToM"}) {
    reset_fake_hd([&](auto& s) {
      s.name = name;
      s.null_opens = 0;
    });
    OpenHapticsDevice device(with_fake_hd());
    CHECK(says(all_statements(device), name));
  }
  reset_fake_hd([](auto& s) { s.name = "Left"; });
  auto options = with_fake_hd();
  options.device = "Left";
  CHECK(hd_refusal(options).empty());
  options.device = "Right";
  CHECK(says(hd_refusal(options), "\"Right\""));
}

TEST_CASE("a device describes itself in SI units") {
  reset_fake_hd();
  const OpenHapticsDevice device(with_fake_hd());
  const DeviceInfo& info = device.info();
  CHECK(info.backend == "openhaptics");
  CHECK(info.model == "Simulated Omni");
  CHECK(info.serial == "F-0001");
  CHECK(info.has_orientation);
  CHECK(info.max_force == 3.3);
  CHECK(info.continuous_force == 0.88);
  CHECK(info.max_stiffness == doctest::Approx(500));
  CHECK(says(all_statements(device), "tested against simulated libraries only"));
}

TEST_CASE("the requested rate is used if the device has it, else 1000 Hz; the measured rate is reported") {
  const auto rate_of = [](double wanted, auto&& change) {
    reset_fake_hd(change);
    OpenHapticsDevice device(with_fake_hd(wanted));
    if (wanted == 1700) CHECK(says(all_statements(device), "refused"));
    return device.info().rate;
  };
  CHECK(rate_of(1600, [](auto&) {}) == 1600);
  CHECK(rate_of(2000, [](auto&) {}) == 2000);
  CHECK(rate_of(1700, [](auto&) {}) == 1000);
  for (unsigned error : {0x101u, 0x304u, 0x102u})
    CHECK(rate_of(1600, [&](auto& s) {
            s.only_rate = 1000;
            s.rate_error = error;
          }) == 1000);
  CHECK(rate_of(1600, [](auto& s) { s.real_rate = 1450; }) == doctest::Approx(1450).epsilon(1e-4));
}

TEST_CASE("calibration runs by itself if no hand is needed; otherwise the user is asked") {
  reset_fake_hd([](auto& s) { s.calibration = 0x5001; });
  CHECK(says(all_statements(OpenHapticsDevice(with_fake_hd())), "calibration: renewed"));
  reset_fake_hd([](auto& s) { s.calibration = 0x5002; });
  CHECK(says(hd_refusal(with_fake_hd()), "inkwell"));
  reset_fake_hd([](auto& s) {
    s.calibration = 0x5002;
    s.style = 1;
  });
  CHECK(says(hd_refusal(with_fake_hd()), "reset position"));
  CHECK(fake_hd().devices_open() == 0);
}

TEST_CASE("a process can open only one device at a time") {
  reset_fake_hd();
  const OpenHapticsDevice first(with_fake_hd());
  CHECK(says(hd_refusal(with_fake_hd()), "already open in this process"));
  const Environment library("PUNCTURA_HD_LIBRARY", FAKE_HD);
  CHECK(backends::openhaptics.status().state == BackendState::in_use);
}

TEST_CASE("a device that must stay open is passed to the next open call") {
  reset_fake_hd();
  auto options = with_fake_hd();
  options.keep_device = true;
  for (int k = 0; k < 3; ++k) {
    CHECK(hd_refusal(options).empty());
    CHECK(fake_hd().devices_open() == 1);
  }
  options.keep_device = false;
  CHECK(hd_refusal(options).empty());
  CHECK(fake_hd().devices_open() == 0);
}

TEST_CASE("the axis is minus the third column of the rotation, with length 1 despite rounding; buttons are read") {
  for (double stretch : {1.0, 1.004, 0.5}) {
    reset_fake_hd([&](auto& s) {
      s.stretch = stretch;
      s.axis[0] = 0.6;
      s.axis[1] = -0.8;
      s.buttons = 2;
    });
    ServoLoop loop(std::make_shared<OpenHapticsDevice>(with_fake_hd()), paper_scene(), patient());
    loop.start();
    until_tick(fake_hd().ticks() + 20);
    const Snapshot s = loop.latest();
    CHECK(s.sample.buttons == 2);
    if (stretch == 0.5) {  // not a rotation: the gate decides
      CHECK(s.fault == Fault::bad_axis);
    } else {
      CHECK(s.fault == Fault::none);
      CHECK(s.sample.axis[0] == doctest::Approx(0.6).epsilon(1e-12));
      CHECK(s.sample.axis[1] == doctest::Approx(-0.8).epsilon(1e-12));
    }
  }
}

TEST_CASE("it also runs in real time on the real clock") {
  reset_fake_hd([](auto& s) { s.fast_ticks = 0; });
  auto options = with_fake_hd(1000);
  options.now_ns = os::now_ns;
  auto device = std::make_shared<OpenHapticsDevice>(options);
  CHECK(device->info().rate > 300);  // a busy machine makes it slower
  CHECK(device->info().rate < 1100);
  ServoLoop loop(device, paper_scene(), patient());
  loop.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  loop.stop();
  CHECK(loop.report().ticks > 5);
  CHECK(held_force() == std::array<double, 3>{0, 0, 0});
}
