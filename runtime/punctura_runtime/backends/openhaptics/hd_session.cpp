#include "punctura_runtime/backends/openhaptics/hd_session.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "punctura/model/decimal.hpp"
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
  return take_errors(hd).code == success && answer[0] > 0 ? answer[0] : not_given;
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

namespace {

using State = BackendStatus::State;

/// Shared by the scheduler's thread and the thread that waits for it.
struct Counting : Work {
  Counting(const Session& session, double duration, std::int64_t (*clock)() noexcept)
      : hd(session.hd()),
        handle(session.handle()),
        tells_calibration(session.tells_calibration()),
        duration_ns(static_cast<std::int64_t>(duration * 1e9)),
        now_ns(clock) {}

  const Interface& hd;
  DeviceHandle handle;
  bool tells_calibration;
  std::int64_t duration_ns;
  std::int64_t (*now_ns)() noexcept;

  std::int64_t first = 0, last = 0;
  std::uint64_t ticks = 0;
  std::uint32_t calibration = calibration_ok;
  int renewals = 0;
  ErrorInfo error{success, 0, no_device};
  Warnings warnings{};
  std::atomic<bool> given_up{false};

  bool call() noexcept {
    if (given_up.load(std::memory_order_relaxed)) return false;
    last = now_ns();
    if (ticks++ == 0) first = last;
    hd.begin_frame(handle);
    // A calibration may take some time to show: check it every 32 ticks, renew it four times at most.
    if (ticks % 32 == 1 && tells_calibration) {
      calibration = hd.check_calibration();
      if (calibration == calibration_needs_update && renewals < 4) {
        ++renewals;
        hd.update_calibration(hd.check_calibration_style());
      }
    }
    hd.end_frame(handle);  // a frame without a force sends zero
    error = take_errors(hd, warnings);
    return error.code == success && last - first < duration_ns;
  }
};

std::string hertz(double rate) { return decimal_text(rate, 6) + " Hz"; }

double run_once(const Lent<Counting>& counting, double patience) {
  Counting& c = *counting;
  const Interface& hd = c.hd;
  const OperationHandle operation = schedule(hd, counting);
  hd.start_scheduler();
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (!c.left.load(std::memory_order_acquire) && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const bool over = c.left.load(std::memory_order_acquire);
  c.given_up = true;
  hd.stop_scheduler();
  hd.unschedule(operation);
  const ErrorInfo after = take_errors(hd);
  if (!over) {
    const std::string why = after.code != success && after.code != bad_handle ? " " + describe(after) + "." : "";
    throw Refusal(State::fault, "The HD scheduler does not call: check the device's power and cable." + why);
  }
  if (c.error.code != success) throw Refusal(State::fault, "The device does not run. " + describe(c.error) + ".");
  return static_cast<double>(c.ticks - 1) * 1e9 / static_cast<double>(c.last - c.first);
}

/// Requests the rate; if the library refuses it, 1000 Hz, which every device has.
void set_rate(const Interface& hd, double wanted, Trial& trial) {
  trial.set = static_cast<unsigned long>(std::lround(std::fmin(wanted, 1e5)));
  hd.set_scheduler_rate(trial.set);
  if (take_errors(hd).code == success) return trial.statements.push_back("rate: asked for " + hertz(wanted));
  trial.set = 1000;
  hd.set_scheduler_rate(trial.set);
  take_errors(hd);
  trial.statements.push_back("rate: asked for " + hertz(wanted) + ", refused by this device, so 1000 Hz instead");
}

}  // namespace

void require_calibration(const Interface& hd, std::uint32_t status) {
  if (status != calibration_needs_manual_input) return;
  throw Refusal(State::needs_calibration, "The device does not know where its stylus is: " +
                                              how_to_calibrate(hd.check_calibration_style()) + ".");
}

Trial try_out(const Session& session, double wanted_rate, double duration, double patience,
              std::int64_t (*now_ns)() noexcept) {
  const Interface& hd = session.hd();
  Trial trial{};
  set_rate(hd, wanted_rate, trial);
  int reported = 0;
  hd.get_integers(update_rate, &reported);
  if (take_errors(hd).code != success) reported = 0;

  // The rate counts for the whole run, so measure again if the computer was busy.
  int renewals = 0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Lent<Counting> counting(new Counting(session, duration, now_ns));
    trial.rate = run_once(counting, duration + patience);
    require_calibration(hd, counting->calibration);
    renewals += counting->renewals;
    if (reported > 0 && std::abs(trial.rate - reported) < 0.02 * reported) break;
  }
  if (!(trial.rate >= 100))
    throw Refusal(State::fault, "The HD scheduler calls at " + hertz(trial.rate) + ": too slow for touch.");
  trial.statements.back() += "; the library says " + hertz(reported) + ", measured " + hertz(trial.rate);
  if (renewals > 0) trial.statements.push_back("calibration: renewed by the library");
  return trial;
}

}  // namespace punctura::hd
