#include "punctura_runtime/backends/openhaptics/hd_session.hpp"

#include <array>
#include <atomic>
#include <limits>

#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"

namespace punctura::hd {

namespace {

using State = BackendStatus::State;

constexpr const char* default_name = "Default Device";

std::atomic<bool> taken{false};

/// A device that stays open between two sessions. Guarded by `taken`.
struct Kept {
  const Interface* hd = nullptr;
  std::string asked, name;
  DeviceHandle handle = no_device;
};
Kept& kept() {
  static auto* one = new Kept;
  return *one;
}

State state_of(std::uint32_t code) noexcept {
  switch (code) {
    case device_already_initiated: return State::in_use;
    case invalid_license:
    case device_fault: return State::fault;
    default: return State::no_device;
  }
}

std::string text(const Interface& hd, Quantity which) {
  const char* answer = hd.get_string(which);
  return take_errors(hd).code == success && answer ? answer : "";
}

double number(const Interface& hd, Quantity which) {
  std::array<double, 16> answer{};  // large enough for any quantity, also a longer one than documented
  hd.get_doubles(which, answer.data());
  return take_errors(hd).code == success && answer[0] > 0 ? answer[0] : unknown;
}

}  // namespace

Session::Place::Place() {
  if (taken.exchange(true))
    throw Refusal(
        State::in_use,
        "A device is already open in this process, and the HD library drives one at a time: close that one first.");
}

Session::Place::~Place() { taken = false; }

Session::Session(const Interface& hd, const std::string& name, bool keep) : hd_(hd), keep_(keep) {
  take_errors(hd_);
  open(name);
  hd_.make_current_device(handle_);
  ask();
}

Session::~Session() {
  if (keep_)
    kept().handle = handle_;
  else
    hd_.disable_device(handle_);
  take_errors(hd_);
}

void Session::open(const std::string& wish) {
  // This name stands for a device that opened without a name.
  const std::string name = wish == default_name ? "" : wish;
  if (Kept& k = kept(); k.handle != no_device && k.hd == &hd_ && (k.asked == name || k.name == name)) {
    handle_ = k.handle;
    name_ = k.name;
    k.handle = no_device;
    return;
  }
  // The default device's name depends on the driver.
  const std::array<const char*, 3> usual{nullptr, default_name, "Default PHANToM"};
  const std::array<const char*, 1> wanted{name.c_str()};
  const char* const* first = name.empty() ? usual.data() : wanted.data();
  const std::size_t count = name.empty() ? usual.size() : wanted.size();

  std::string tried;
  State state = State::no_device;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string shown = first[i] ? "\"" + std::string(first[i]) + "\"" : "The default device";
    handle_ = hd_.init_device(first[i]);
    ErrorInfo error = take_errors(hd_);
    if (handle_ != no_device && error.code == success) {
      name_ = first[i] ? first[i] : default_name;
      if (keep_) kept() = {&hd_, name, name_, no_device};
      return;
    }
    if (handle_ != no_device) hd_.disable_device(handle_);
    take_errors(hd_);
    if (error.code == success) error.code = bad_handle;
    const std::string why = " gave " + describe(error) + ".";
    if (tried.ends_with(why)) tried.replace(tried.size() - why.size(), why.size(), ",");  // one reason, given once
    tried += " " + shown + why;
    if (const State now = state_of(error.code); now != State::no_device) {  // another name would not help
      state = now;
      break;
    }
  }
  throw Refusal(state, "No device could be opened." + tried);
}

void Session::ask() {
  info_.backend = "openhaptics";
  info_.model = text(hd_, model_type);
  info_.serial = text(hd_, serial_number);
  int axes = 6;
  hd_.get_integers(input_dof, &axes);
  info_.has_orientation = take_errors(hd_).code != success || axes >= 6;
  info_.button_count = 4;  // the number of bits; the library does not give the number of buttons
  info_.max_force = number(hd_, nominal_max_force);
  info_.continuous_force = number(hd_, nominal_max_continuous_force);
  info_.max_stiffness = number(hd_, nominal_max_stiffness) * 1e3;
  std::array<double, 16> temperatures{};
  hd_.get_doubles(motor_temperature, temperatures.data());
  tells_temperature_ = take_errors(hd_).code == success;
  hd_.check_calibration();
  tells_calibration_ = take_errors(hd_).code == success;
}

}  // namespace punctura::hd
