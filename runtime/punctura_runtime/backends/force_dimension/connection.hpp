// A Force Dimension device while it is open: found, asked about itself, closed.
#pragma once

#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"
#include "punctura_runtime/backends/status.hpp"

namespace punctura::force_dimension {

/// Why a device does not open, as a state and in words.
class Refusal : public DeviceError {
 public:
  Refusal(BackendStatus::State why, const std::string& detail) : DeviceError(detail), state(why) {}
  BackendStatus::State state;
};

/// Open from construction on. To open gives no force and moves nothing.
class Connection {
 public:
  /// index: counted from 0. Throws Refusal, also where this program has it open already.
  Connection(const Api& api, int index);
  ~Connection();
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&&) = delete;

  char id() const noexcept { return id_; }
  std::string model() const;
  std::string serial() const;
  std::string label() const { return model() + " " + serial(); }  ///< the name by which it is chosen
  bool calibrated() const;                                        ///< Throws Refusal
  DeviceInfo info() const;                                        ///< all but the rate

 private:
  const Api& api_;
  char id_ = 0;
  bool open_ = false;
};

/// The device called so: by label, model or serial number; the first that opens where the name is empty. Throws Refusal.
Connection connect(const Api& api, const std::string& name);

/// Has the arm find its zero by itself: it moves. Throws Refusal.
void auto_init(const Api& api, const std::string& name);

/// All that open, by label, and what stands against each that does not; throws Refusal where none is plugged in.
struct Survey {
  std::vector<std::string> ready, uncalibrated;
  std::vector<Refusal> refusals;
};
Survey survey(const Api& api);

/// What an error number means and what to do; the library's own text where we have none.
std::string words_for(const Api& api, int error);
/// What to do with a device that does not know where it is.
std::string calibration_advice(const std::string& label);

}  // namespace punctura::force_dimension
