#include "punctura_runtime/backends/force_dimension/device.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"

namespace punctura::force_dimension {

inline constexpr double for_the_rest = 0.05;  ///< share of a period for all that a tick does beside reading

/// Hz. Reads as fast as possible, without force, and takes the median time between new readings, so that a short delay
/// of the computer has no effect. `not_given` if readings take no time or fail; the first tick then reports why.
template <typename Clock>
double measured_rate(const Api& api, char id, const Clock& clock) {
  constexpr int enough = 50, most = 100'000;
  constexpr std::int64_t time_limit = 200'000'000;  // ns
  std::vector<std::int64_t> took;
  const std::int64_t begin = clock.now();
  std::int64_t last = begin;
  for (int n = 0; n < most && took.size() < enough && last - begin < time_limit; ++n) {
    double x = 0, y = 0, z = 0, frame[3][3] = {};
    const int got = api.read(&x, &y, &z, frame, id);
    if (got < 0) return not_given;
    if (got == time_guard) continue;
    const std::int64_t now = clock.now();
    took.push_back(now - last);
    last = now;
  }
  if (took.empty()) return not_given;
  const auto middle = took.begin() + static_cast<std::ptrdiff_t>(took.size() / 2);
  std::nth_element(took.begin(), middle, took.end());
  return *middle > 0 ? (1 - for_the_rest) * 1e9 / static_cast<double>(*middle) : not_given;
}

namespace {

/// A status query may cost a USB transfer, so not every tick makes one. That is early enough: the device itself has cut
/// the force by then; Punctura only reports it and keeps the force off.
constexpr double status_interval = 0.004;  // s
constexpr double time_for_force = 0.5;     // s after start() within which the device must switch its force on

}  // namespace

ForceDimensionDevice::ForceDimensionDevice(Options options) : options_(std::move(options)) {
  const double norm = std::hypot(options_.tool[0], options_.tool[1], options_.tool[2]);
  if (!(norm > 0) || !std::isfinite(norm))
    throw DeviceError("the tool direction must be three finite numbers that are not all 0");
  require_rate(options_.rate);
  for (double& component : options_.tool) component /= norm;
  pacing_ = {true, true, options_.realtime, options_.clock};
  library_ = load(options_.library);
  if (library_.state != BackendStatus::State::available) throw Refusal(library_.state, library_.detail);
  open();
}

void ForceDimensionDevice::open() {
  const Api& api = library_.api;
  connection_.emplace(connect(api, options_.device));
  const std::string label = connection_->label();
  try {
    if (!connection_->calibrated()) {
      if (!options_.auto_init) throw Refusal(BackendStatus::State::needs_calibration, calibration_advice(label));
      connection_.reset();
      auto_init(api, label);
      connection_.emplace(connect(api, label));
      if (!connection_->calibrated()) throw Refusal(BackendStatus::State::needs_calibration, calibration_advice(label));
    }
    info_ = connection_->info();
  } catch (...) {
    connection_.reset();
    throw;
  }
  options_.device = label;  // start() after stop() opens the same device
  id_ = connection_->id();
  info_.rate = std::min(options_.rate, fastest);
  if (const double measured = measured_rate(api, id_, options_.clock); measured < info_.rate) info_.rate = measured;
}

void ForceDimensionDevice::begin() {
  if (!connection_) open();
  trouble_ = Trouble::none;
  saturated_ = repeated_ = 0;
  sample_.axis = to_ours(options_.tool);  // for a device without a wrist: as if the handle were straight
  force_seen_ = false;
  status_every_ = static_cast<std::uint64_t>(std::max(1.0, std::round(info_.rate * status_interval)));

  const Api& api = library_.api;
  int status[status_size] = {};
  if (api.status(status, id_) < 0) throw DeviceError(info_.model + ": " + words_for(api, api.last_error()));
  error_at_start_ = status[status_error] != 0;
}

void ForceDimensionDevice::stop() noexcept {
  PolledDevice::stop();  // the ticking thread switches the force off before it ends
  connection_.reset();
}

/// After memory is locked: that may take longer than the device's watchdog waits for a command.
std::string ForceDimensionDevice::prepare() noexcept {
  const Api& api = library_.api;
  api.write(0, 0, 0, 0, 0, 0, 0, id_);  // may be refused while forces are off, without harm
  if (api.enable_force(1, id_) >= 0) return {};
  const int code = api.last_error();
  end();
  return info_.model + " does not switch its force on: " + words_for(api, code);
}

/// Zero force, then force off: both, even if the first fails.
void ForceDimensionDevice::end() noexcept {
  library_.api.write(0, 0, 0, 0, 0, 0, 0, id_);
  library_.api.enable_force(0, id_);
}

ForceDimensionDevice::Next ForceDimensionDevice::read() noexcept {
  const Api& api = library_.api;
  sample_.time = now();
  double x = 0, y = 0, z = 0, frame[3][3] = {};
  const int got = api.read(&x, &y, &z, frame, id_);
  if (got < 0) {
    fail(Trouble::reading, api.last_error());
    return Next::trouble;
  }
  if (got == time_guard && count() > 0) {
    repeated_.fetch_add(1, std::memory_order_relaxed);
  } else {
    ++sample_.sequence;
    sample_.position = to_ours({x, y, z});
    if (info_.has_orientation) sample_.axis = to_ours(turned(frame, options_.tool));
  }
  sample_.buttons = api.buttons(id_);
  if (count() % status_every_ == 0 && !watch()) return Next::trouble;
  sample_.healthy = trouble_.load(std::memory_order_relaxed) == Trouble::none;
  return Next::tick;
}

ForceDimensionDevice::Next ForceDimensionDevice::write(const Tick::Force& force) noexcept {
  const Triple f = to_device(force);
  const int written = library_.api.write(f[0], f[1], f[2], 0, 0, 0, 0, id_);
  if (written < 0) {
    fail(Trouble::writing, library_.api.last_error());
    return Next::trouble;
  }
  if (written == motor_saturated) saturated_.fetch_add(1, std::memory_order_relaxed);
  return Next::tick;
}

/// Checks the device's status. False if the query fails.
bool ForceDimensionDevice::watch() noexcept {
  const Api& api = library_.api;
  int status[status_size] = {};
  if (api.status(status, id_) < 0) {
    fail(Trouble::reading, api.last_error());
    return false;
  }
  // The device is in one of four modes: reset, idle, force, brake.
  const bool force = status[status_force] != 0 && status[status_brake] == 0;
  if (status[status_reset] != 0) {
    fail(Trouble::calibration_lost, 0);
  } else if (status[status_error] != 0 && !error_at_start_) {
    fail(Trouble::controller, 0);
  } else if (force_seen_ && !force) {
    fail(Trouble::force_off, status[status_force_off_cause]);
  } else if (!force && sample_.time > time_for_force) {
    fail(Trouble::force_never_on, 0);
  }
  force_seen_ = force_seen_ || force;
  return true;
}

/// Keeps the first trouble only.
void ForceDimensionDevice::fail(Trouble what, int code) noexcept {
  if (trouble_.load(std::memory_order_relaxed) != Trouble::none) return;
  code_.store(code, std::memory_order_relaxed);
  trouble_.store(what, std::memory_order_release);
}

}  // namespace punctura::force_dimension

namespace punctura {

namespace {

using namespace force_dimension;
constexpr const char* name = "force_dimension";

BackendStatus status() {
  using State = BackendStatus::State;
  const Loaded library = load();
  if (library.state != State::available) return {name, library.state, library.detail, {}};
  try {
    const Survey found = survey(library.api);
    const std::string by = " By " + library.path + ".";
    if (!found.ready.empty())
      return {name, State::available, joined(found.ready) + ": can be opened." + by, found.ready};
    if (!found.uncalibrated.empty())
      return {name, State::needs_calibration, calibration_advice(found.uncalibrated.front()) + by, found.uncalibrated};
    const Refusal& why = found.refusals.front();
    return {name, why.state, std::string(why.what()) + "." + by, {}};
  } catch (const Refusal& why) {
    return {name, why.state, why.what(), {}};
  }
}

std::shared_ptr<Device> open(const OpenOptions& how) { return std::make_shared<ForceDimensionDevice>(Options{how}); }

}  // namespace

const Backend backends::force_dimension{name, &status, &open};

}  // namespace punctura
