#include "punctura_runtime/backends/force_dimension/connection.hpp"

#include <mutex>
#include <set>
#include <utility>

namespace punctura::force_dimension {

namespace {

using State = BackendStatus::State;

/// The maker's ratings of a family of devices, which the libraries do not give; NaN if not known. Continuous ratings
/// are not published.
struct Model {
  double max_force = not_given;      ///< N
  double max_stiffness = not_given;  ///< N/m
  unsigned buttons = 1;
};

inline constexpr Model omega{12, 5000, 1}, sigma{12, 4000, 1}, lambda{12, 8000, 1}, falcon{8, 3000, 4};

/// The library's type numbers. Two numbers with the same name are the right-handed and the left-handed device.
struct NumberedModel {
  int system_type;
  Model model;
};
inline constexpr NumberedModel models[] = {
    {33, omega},                                               // omega.3
    {34, omega},   {36, omega},   {35, omega},   {37, omega},  // omega.6, omega.7
    {206, sigma},  {104, sigma},  {105, sigma},                // sigma.3, sigma.7
    {203, lambda}, {131, lambda}, {132, lambda},               // lambda.3, lambda.6
    {108, lambda}, {109, lambda},                              // lambda.7
    {60, falcon},                                              // Novint Falcon
};

/// Nothing is known of other types, for example delta.3 (63).
constexpr Model model_of(int system_type) noexcept {
  for (const NumberedModel& known : models)
    if (known.system_type == system_type) return known.model;
  return {};
}

/// The numbers of the devices that this program has open. The library gives the same number if it opens one of them
/// again; closing that one would close both.
struct Ours {
  std::mutex mutex;
  std::set<std::pair<const void*, char>> ids;  // by library
};
Ours& ours() {
  static auto& all = *new Ours;  // never destroyed: a device may be closed at the end of the program
  return all;
}
const void* library_of(const Api& api) { return reinterpret_cast<const void*>(api.open); }

State state_for(int error) {
  switch (static_cast<ApiError>(error)) {
    case ApiError::in_use: return State::in_use;
    case ApiError::no_device: return State::no_device;
    default: return State::fault;
  }
}

Refusal refusal(const Api& api, const std::string& what) {
  const int error = api.last_error();  // the last error of this thread
  return {state_for(error), what + ": " + words_for(api, error)};
}

int count(const Api& api) {
  const int plugged_in = api.device_count();
  if (plugged_in < 0) throw refusal(api, "Force Dimension's library cannot look for devices");
  if (plugged_in == 0)
    throw Refusal(
        State::no_device,
        "No Force Dimension device and no Falcon was found. Check power and USB cable; on Linux, also that a udev rule "
        "lets you use it (docs/devices-force-dimension.md).");
  if (api.available_count() == 0) {
    const std::lock_guard lock(ours().mutex);
    throw Refusal(State::in_use, ours().ids.empty() ? "Another program has the device open: close that first."
                                                    : "This program has the device open already.");
  }
  return plugged_in;
}

}  // namespace

std::string words_for(const Api& api, int error) {
  switch (static_cast<ApiError>(error)) {
    case ApiError::communication: return "the connection to the device is gone: check its USB cable and power";
    case ApiError::no_driver:
      return "its USB driver is missing, or you may not use it: see docs/devices-force-dimension.md for the udev rule";
    case ApiError::no_device: return "no such device: check power and USB cable";
    case ApiError::timeout: return "the device did not answer in time";
    case ApiError::not_ready: return "the device is not ready: switch it off and on, and calibrate it";
    case ApiError::in_use: return "another program has the device open: close that first";
    default: break;
  }
  const char* text = api.error_text(error);
  return std::string(text ? text : "unknown") + " (error " + std::to_string(error) + " of Force Dimension's library)";
}

std::string calibration_advice(const std::string& label) {
  return label +
         " does not know where it is: it needs calibration, once each time it is switched on. "
         "Put the end of its handle into the calibration pit "
         "(a Falcon: push its grip all the way in and pull it all the way out) until the status light stops blinking, "
         "or run the maker's own initialisation program.";
}

Connection::Connection(const Api& api, int index) : api_(api) {
  const std::lock_guard lock(ours().mutex);
  const int opened = api.open(static_cast<char>(index));
  if (opened < 0) throw refusal(api, "Device " + std::to_string(index) + " does not open");
  id_ = static_cast<char>(opened);
  if (!ours().ids.insert({library_of(api), id_}).second)
    throw Refusal(State::in_use, "Device " + std::to_string(index) + " is open in this program already.");
  open_ = true;
}

Connection::Connection(Connection&& other) noexcept
    : api_(other.api_), id_(other.id_), open_(std::exchange(other.open_, false)) {}

Connection::~Connection() {
  if (!open_) return;
  const std::lock_guard lock(ours().mutex);
  api_.close(id_);  // nothing can be done if it fails
  ours().ids.erase({library_of(api_), id_});
}

std::string Connection::model() const {
  const char* name = api_.system_name(id_);
  return name && *name ? name : "unnamed device";
}

std::string Connection::serial() const {
  unsigned short number = 0;
  return api_.serial_number(&number, id_) < 0 ? "" : std::to_string(number);
}

bool Connection::calibrated() const {
  int status[status_size] = {};
  if (api_.status(status, id_) < 0) throw refusal(api_, label() + " does not tell its state");
  return status[status_reset] == 0;
}

DeviceInfo Connection::info() const {
  const Model known = model_of(api_.system_type(id_));
  const double limit = api_.max_force(id_);
  DeviceInfo info;
  info.backend = "force_dimension";
  info.model = model();
  info.serial = serial();
  info.has_orientation = api_.has_wrist(id_) != 0;
  info.button_count = known.buttons;
  info.max_force = limit > 0 ? limit : known.max_force;
  info.max_stiffness = known.max_stiffness;
  return info;
}

Connection connect(const Api& api, const std::string& name) {
  const int plugged_in = count(api);
  std::string seen;
  State state = State::no_device;
  for (int index = 0; index < plugged_in; ++index) {
    try {
      Connection device(api, index);
      if (name.empty() || name == device.label() || name == device.model() || name == device.serial()) return device;
      seen += (seen.empty() ? "" : "; ") + device.label();
    } catch (const Refusal& why) {
      seen += (seen.empty() ? "" : "; ") + std::string(why.what());
      state = why.state;
    }
  }
  if (name.empty()) throw Refusal(state, seen);
  throw Refusal(state, "No device called '" + name + "' could be opened; there is: " + seen);
}

void auto_init(const Api& api, const std::string& name) {
  if (!api.robot_open || !api.robot_close || !api.robot_auto_init)
    throw Refusal(
        State::symbol_missing,
        "To calibrate by itself the device needs Force Dimension's robotics library (libdrd); only libdhd was found. " +
            calibration_advice(name));
  for (int index = 0, plugged_in = count(api); index < plugged_in; ++index) {
    if (Connection(api, index).label() != name) continue;
    const int id = api.robot_open(static_cast<char>(index));
    if (id < 0) throw refusal(api, name + " does not open for calibration");
    const int result = api.robot_auto_init(static_cast<char>(id));
    const int error = result < 0 ? api.last_error() : 0;
    api.robot_close(static_cast<char>(id));
    if (result < 0) throw Refusal(state_for(error), name + " could not calibrate itself: " + words_for(api, error));
    return;
  }
  throw Refusal(State::no_device, name + " is not there any more.");
}

Survey survey(const Api& api) {
  Survey all;
  for (int index = 0, plugged_in = count(api); index < plugged_in; ++index) {
    try {
      const Connection device(api, index);
      (device.calibrated() ? all.ready : all.uncalibrated).push_back(device.label());
    } catch (const Refusal& why) {
      all.refusals.push_back(why);
    }
  }
  return all;
}

}  // namespace punctura::force_dimension
