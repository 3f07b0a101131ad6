// An open Force Dimension device.
#pragma once

#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"

namespace punctura::force_dimension {

/// The constructor opens the device. That gives no force and moves nothing.
class Connection {
 public:
  /// index: counted from 0. Throws Refusal, also if this program has it open already.
  Connection(const Api& api, int index);
  ~Connection();
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&&) = delete;

  char id() const noexcept { return id_; }
  std::string model() const;
  std::string serial() const;
  std::string label() const { return model() + " " + serial(); }  ///< the name to open it by
  bool calibrated() const;                                        ///< Throws Refusal
  DeviceInfo info() const;                                        ///< all but the rate

 private:
  const Api& api_;
  char id_ = 0;
  bool open_ = false;
};

/// Opens the device with this label, model or serial number; with an empty name, the first that opens. Throws Refusal.
Connection connect(const Api& api, const std::string& name);

/// Lets the arm calibrate itself. THE ARM MOVES. Throws Refusal.
void auto_init(const Api& api, const std::string& name);

/// The labels of all devices that open, and why each of the others does not. Throws Refusal if none is plugged in.
struct Survey {
  std::vector<std::string> ready, uncalibrated;
  std::vector<Refusal> refusals;
};
Survey survey(const Api& api);

/// What an error number means and what to do; the library's own text for numbers that are not known here.
std::string words_for(const Api& api, int error);
/// How to calibrate a device.
std::string calibration_advice(const std::string& label);

}  // namespace punctura::force_dimension
