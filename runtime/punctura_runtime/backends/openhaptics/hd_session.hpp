// An open device of the HD library and its data. No force, no thread.
#pragma once

#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"
#include "punctura_runtime/backends/status.hpp"

namespace punctura::hd {

/// Opens in the constructor, closes in the destructor. One at a time in a process: the library has one scheduler and
/// one stack of errors.
class Session {
 public:
  /// name: as the maker's setup tool shows it; empty tries the usual names of the default device. keep: leaves the
  /// device open for the next session, since some FireWire drivers crash when it is closed. Throws Refusal.
  Session(const Interface& hd, const std::string& name, bool keep);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Interface& hd() const noexcept { return hd_; }
  DeviceHandle handle() const noexcept { return handle_; }
  const DeviceInfo& info() const noexcept { return info_; }
  const std::string& name() const noexcept { return name_; }  ///< the name that it opened with
  bool tells_temperature() const noexcept { return tells_temperature_; }
  bool tells_calibration() const noexcept { return tells_calibration_; }

 private:
  /// The only session of the process; released also if the constructor throws.
  struct Place {
    Place();
    ~Place();
  };
  void open(const std::string& name);
  void ask();

  Place place_;
  const Interface& hd_;
  bool keep_;
  DeviceHandle handle_ = no_device;
  DeviceInfo info_;
  std::string name_;
  bool tells_temperature_ = false, tells_calibration_ = false;
};

}  // namespace punctura::hd
