// The status of a back-end before a device is opened: it shows why a device is missing.
#pragma once

#include <string>
#include <vector>

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

/// For programs: "available", "library_not_found", ...
constexpr const char* name_of(BackendStatus::State state) noexcept {
  switch (state) {
    case BackendStatus::State::available: return "available";
    case BackendStatus::State::library_not_found: return "library_not_found";
    case BackendStatus::State::symbol_missing: return "symbol_missing";
    case BackendStatus::State::no_device: return "no_device";
    case BackendStatus::State::in_use: return "in_use";
    case BackendStatus::State::needs_calibration: return "needs_calibration";
    case BackendStatus::State::fault: return "fault";
  }
  return "fault";
}

}  // namespace punctura
