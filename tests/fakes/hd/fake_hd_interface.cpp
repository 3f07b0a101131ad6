// The functions of the real library, with its names and constants, implemented by the fake.
#include <cstring>

#include "fake_hd.hpp"

using fake_hd::Fake;

namespace {

// Some are unused in a build that leaves out functions.
[[maybe_unused]] constexpr std::uint32_t invalid_enum = 0x100, invalid_input_type = 0x103, bad_handle = 0x104,
                                         already_initiated = 0x301;
constexpr std::uint32_t no_device = 0xFFFFFFFF;

Fake& fake() { return Fake::one(); }
using Locked = std::lock_guard<std::mutex>;

/// For values that are single numbers.
bool number(std::uint32_t which, double& value) {
  const auto& s = fake().settings;
  switch (which) {
    case 0x2000: value = fake().last.buttons; return true;
    case 0x2001: value = 1; return true;
    case 0x2002: value = 1; return true;
    case 0x2500: value = 3.4; return true;
    case 0x2553: value = 6; return true;
    case 0x2554: value = 3; return true;
    case 0x2555: value = s.style; return true;
    case 0x2600: value = static_cast<double>(fake().rate); return true;
    case 0x2601: value = s.real_rate > 0 ? s.real_rate : static_cast<double>(fake().rate); return true;
    case 0x2602: value = 0.5; return true;   // N/mm
    case 0x2603: value = 3.3; return true;   // N
    case 0x2604: value = 0.88; return true;  // N
    default: return false;
  }
}

bool numbers(std::uint32_t which, double* values) {
  const auto& f = fake();
  const auto give = [&](const auto& all) { std::copy(all.begin(), all.end(), values); };
  switch (which) {
    case 0x2050: give(f.last.position); return true;
    case 0x2052: give(f.last.transform); return true;
    case 0x2051:
    case 0x2053:
    case 0x2100:
    case 0x2150: give(std::array<double, 3>{}); return true;
    case 0x2551: give(std::array<double, 6>{-80, -60, -35, 80, 60, 35}); return true;
    case 0x2605: give(std::array<double, 6>{0, f.settings.temperature, 0, 0, 0, 0}); return true;
    case 0x2700: give(f.wanted); return true;
    case 0x2800: give(f.held); return true;
    default: return number(which, values[0]);
  }
}

}  // namespace

EXPORT std::uint32_t hdInitDevice(const char* name) {
  Fake& f = fake();
  const Locked lock(f.state);
  const std::uint32_t error = f.settings.init_error                                   ? f.settings.init_error
                              : !(name ? name == f.name : f.settings.null_opens != 0) ? bad_handle
                              : f.open                                                ? already_initiated
                                                                                      : 0;
  if (error != 0) {
    f.push(error);
    return no_device;
  }
  f.open = true;
  return f.current = fake_hd::handle_given;
}

EXPORT void hdDisableDevice(std::uint32_t device) {
  Fake& f = fake();
  const Locked lock(f.state);
  if (!f.open || device != fake_hd::handle_given) return f.misuse(bad_handle);
  f.open = f.force_output = false;
  f.current = no_device;
}

EXPORT void hdMakeCurrentDevice(std::uint32_t device) {
  Fake& f = fake();
  const Locked lock(f.state);
  if (!f.open || device != fake_hd::handle_given) return f.misuse(bad_handle);
  f.current = device;
}

EXPORT std::uint32_t hdGetCurrentDevice() {
  const Locked lock(fake().state);
  return fake().current;
}

EXPORT void hdBeginFrame(std::uint32_t device) { fake().begin_frame(device); }
EXPORT void hdEndFrame(std::uint32_t device) { fake().end_frame(device); }

/// The newest error first.
EXPORT fake_hd::ErrorInfo hdGetError() {
  Fake& f = fake();
  const Locked lock(f.state);
  if (f.errors.empty()) return {0, 0, no_device};
  const auto error = f.errors.back();
  f.errors.pop_back();
  return error;
}

EXPORT const char* hdGetErrorString(std::uint32_t code) { return code == 0 ? "no error" : "an error"; }

namespace {
void switch_to(std::uint32_t which, bool on) {
  Fake& f = fake();
  const Locked lock(f.state);
  if (which == 0x4000)
    f.force_output = on;  // takes effect with the next frame
  else if (which == 0x4004)
    f.one_frame = on;
  else if (which < 0x4000 || which > 0x4004)
    f.misuse(invalid_enum);
}
}  // namespace

EXPORT void hdEnable(std::uint32_t which) { switch_to(which, true); }
EXPORT void hdDisable(std::uint32_t which) { switch_to(which, false); }

EXPORT unsigned char hdIsEnabled(std::uint32_t which) {
  const Locked lock(fake().state);
  return which == 0x4000 ? fake().force_output : which == 0x4004 ? fake().one_frame : false;
}

EXPORT void hdGetDoublev(std::uint32_t which, double* values) {
  const Locked lock(fake().state);
  if (!numbers(which, values)) fake().misuse(invalid_enum);
}

EXPORT void hdGetIntegerv(std::uint32_t which, int* values) {
  const Locked lock(fake().state);
  double value = 0;
  if (!number(which, value)) return fake().misuse(invalid_enum);
  values[0] = static_cast<int>(value);
}

EXPORT void hdSetDoublev(std::uint32_t which, const double* values) {
  if (which == 0x2700) return fake().set_force(values);
  const Locked lock(fake().state);
  fake().misuse(invalid_enum);
}

#ifndef FAKE_HD_INCOMPLETE
EXPORT const char* hdGetString(std::uint32_t which) {
  switch (which) {
    case 0x2501: return "Simulated Omni";
    case 0x2503: return "Nobody";
    case 0x2504: return "F-0001";
    default: break;
  }
  const Locked lock(fake().state);
  fake().misuse(which >= 0x2500 && which <= 0x2505 ? invalid_input_type : invalid_enum);
  return nullptr;
}

EXPORT void hdUpdateCalibration(std::uint32_t) {
  const Locked lock(fake().state);
  if (fake().settings.renewing_works) fake().settings.calibration = 0x5000;
}
#endif

EXPORT std::uint32_t hdCheckCalibration() {
  const Locked lock(fake().state);
  return fake().settings.calibration;
}

EXPORT std::uint32_t hdCheckCalibrationStyle() {
  const Locked lock(fake().state);
  return fake().settings.style;
}

EXPORT void hdStartScheduler() { fake().start(); }
EXPORT void hdStopScheduler() { fake().stop(); }
EXPORT void hdSetSchedulerRate(unsigned long hz) { fake().set_rate(hz); }

EXPORT unsigned long hdScheduleAsynchronous(fake_hd::Operation operation, void* data, std::uint16_t priority) {
  return fake().schedule(operation, data, priority);
}
EXPORT void hdScheduleSynchronous(fake_hd::Operation operation, void* data, std::uint16_t) {
  fake().synchronously(operation, data);
}
EXPORT void hdUnschedule(unsigned long handle) { fake().unschedule(handle); }
EXPORT double hdGetSchedulerTimeStamp() { return 0; }
