// A device of 3D Systems (Touch, Touch X, PHANTOM Omni ...) through the HD library of OpenHaptics, which calls us at
// its own rate. Tested against simulated libraries only.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/openhaptics/hd_session.hpp"
#include "punctura_runtime/backends/openhaptics/openhaptics_tick.hpp"

namespace punctura {

struct OpenHapticsOptions : OpenOptions {
  bool keep_device = false;                        ///< never closes it: some FireWire drivers crash when it is closed
  double trial = 0.25;                             ///< s: duration of the measurement of the rate
  double patience = 2;                             ///< s: how much longer the measurement may take
  std::int64_t (*now_ns)() noexcept = os::now_ns;  ///< tests replace it
};

class OpenHapticsDevice : public Device {
 public:
  /// Loads the library, opens the device, renews its calibration, measures its rate. Throws Refusal, which is a
  /// DeviceError.
  explicit OpenHapticsDevice(const OpenHapticsOptions& options);
  ~OpenHapticsDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

 private:
  void halt() noexcept;
  void lend();
  hd::Ticking& ticking() const noexcept { return *ticking_; }

  OpenHapticsOptions options_;
  hd::Session session_;
  const hd::Interface& hd_;
  hd::Trial trial_;
  DeviceInfo info_;
  std::mutex control_;  ///< held by start() and stop(), never by the tick
  hd::OperationHandle operation_ = 0;

  std::atomic<bool> running_{false};
  std::vector<hd::Lent<hd::Ticking>> lent_;  ///< to the scheduler; the last one is the present one
  std::atomic<hd::Ticking*> ticking_{nullptr};
};

}  // namespace punctura
