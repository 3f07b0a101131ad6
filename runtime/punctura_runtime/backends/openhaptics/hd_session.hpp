// An open device of the HD library and its data, and a trial of its scheduler. No force.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

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

struct Trial {
  unsigned long set;                    ///< Hz, as accepted by the library
  double rate;                          ///< measured, Hz
  std::vector<std::string> statements;  ///< for the user
};

/// Sets the rate, measures it over `duration` (s), and renews the calibration if that needs no user. Throws Refusal,
/// also if the measurement takes longer by more than `patience` (s).
Trial try_out(const Session& session, double wanted_rate, double duration, double patience,
              std::int64_t (*now_ns)() noexcept);

/// Throws Refusal if the user must calibrate the device.
void require_calibration(const Interface& hd, std::uint32_t status);

}  // namespace punctura::hd
