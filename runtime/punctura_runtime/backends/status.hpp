// What a back-end says of itself before anything is opened, so that a user can see why a device is not there.
#pragma once

#include <string>
#include <vector>

namespace punctura {

struct BackendStatus {
  enum class State {
    available,          ///< it can be opened now
    library_not_found,  ///< the maker's software is not installed, or not where we look
    symbol_missing,     ///< it is installed, but of a version that lacks a function
    no_device,          ///< nothing is plugged in, or nothing answers
    in_use,             ///< somebody has it open: this process, or another
    needs_calibration,  ///< its user has to do something first
    fault,              ///< anything else
  };

  std::string backend;
  State state;
  std::string detail;                ///< where it looked, which symbol, what to do: whole sentences
  std::vector<std::string> devices;  ///< what can be opened, as open_device() takes it or as its maker names it
};

/// As a program reads it: "available", "library_not_found", ...
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
