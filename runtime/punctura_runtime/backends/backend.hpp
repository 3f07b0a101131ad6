// A back-end as the registry sees it: its name, its status, and a function that opens its device.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/model/decimal.hpp"
#include "punctura/model/field.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

struct BackendStatus {
  enum class State {
    available,          ///< it can be opened now
    library_not_found,  ///< the maker's software is not installed, or not in the searched places
    symbol_missing,     ///< it is installed, but lacks a function
    no_device,          ///< nothing is plugged in, or nothing answers
    in_use,             ///< this process or another one has it open
    needs_calibration,  ///< the user must calibrate it first
    fault,              ///< anything else
  };

  std::string backend;
  State state;
  std::string detail;                ///< the reason and what to do, in whole sentences
  std::vector<std::string> devices;  ///< the devices by the names that open_device() takes, or by the maker's
};

/// For programs.
template <>
inline constexpr std::array<std::string_view, 7> words_of<BackendStatus::State>{
    "available", "library_not_found", "symbol_missing", "no_device", "in_use", "needs_calibration", "fault"};

/// Why a device does not open: the state that enumerate_devices() gives, and a message.
class Refusal : public DeviceError {
 public:
  Refusal(BackendStatus::State why, const std::string& detail) : DeviceError(detail), state(why) {}
  BackendStatus::State state;
};

struct OpenOptions {
  double rate = usual_rate;         ///< Hz, requested; `info().rate` of the device is the actual rate
  std::string device;               ///< the maker's name of it; empty is the first
  std::string library;              ///< path of the maker's library; empty searches the usual places
  os::RealtimeSettings realtime{};  ///< of the ticking thread, unless a maker's library owns it
};

/// Throws DeviceError if a rate is not above 0 Hz. what: "the rate of a recording".
inline void require_rate(double rate, const std::string& what = "the rate") {
  if (!(rate > 0) || !std::isfinite(rate)) throw DeviceError(what + " must be above 0 Hz, not " + decimal_text(rate));
}

struct Backend {
  const char* name;
  BackendStatus (*status)();                                ///< no motion, no force
  std::shared_ptr<Device> (*open)(const OpenOptions& how);  ///< throws DeviceError
};

/// Built in: each is defined in a file of its own and listed in registry.cpp. register_backend() adds others.
namespace backends {
extern const Backend openhaptics;
extern const Backend force_dimension;
extern const Backend haply;
extern const Backend replay;
extern const Backend simulated;
}  // namespace backends

}  // namespace punctura
