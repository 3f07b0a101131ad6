// The status of a back-end before a device is opened: it shows why a device is missing.
#pragma once

#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/model/words.hpp"

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

}  // namespace punctura
