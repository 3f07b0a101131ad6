// A device of 3D Systems (Touch, Touch X, PHANTOM Omni ...) through the HD library of OpenHaptics, which calls us at
// its own rate. Tested against simulated libraries only.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>

#include "punctura/device/device.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"
#include "punctura_runtime/backends/openhaptics/hd_session.hpp"
#include "punctura_runtime/backends/openhaptics/hd_trial.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

struct OpenHapticsOptions {
  double rate = usual_rate;                        ///< Hz, requested
  std::string device;                              ///< empty is the default device
  std::string library;                             ///< empty searches the usual places
  bool keep_device = false;                        ///< never closes it: some FireWire drivers crash when it is closed
  double trial = 0.25;                             ///< s: duration of the measurement of the rate
  double patience = 2;                             ///< s: how much longer the measurement may take
  std::int64_t (*now_ns)() noexcept = os::now_ns;  ///< tests replace it
};

class OpenHapticsDevice : public Device {
 public:
  /// Loads the library, opens the device, renews its calibration, measures its rate. Throws hd::Refused, which is a
  /// DeviceError.
  explicit OpenHapticsDevice(const OpenHapticsOptions& options);
  ~OpenHapticsDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

 private:
  enum class Ending { none, error, calibration };

  // openhaptics.cpp: on the thread that starts and stops.
  void halt() noexcept;

  // openhaptics_tick.cpp: on the scheduler's thread.
  static std::uint32_t call(void* self) noexcept;
  bool one_tick() noexcept;
  hd::ErrorInfo read() noexcept;
  void give(const Tick::Force& force) noexcept;
  bool zero_frame() noexcept;
  void leave(Ending why, const hd::ErrorInfo& error) noexcept;
  static constexpr std::uint64_t temperature_every = 64, calibration_every = 256;  ///< ticks
  static constexpr int most_farewells = 32;                                        ///< frames of zero force

  OpenHapticsOptions options_;
  hd::Session session_;
  const hd::Interface& hd_;
  hd::Trial trial_;
  DeviceInfo info_;
  std::mutex control_;  ///< held by start() and stop(), never by the tick
  hd::OperationHandle operation_ = 0;

  // Used by the scheduler's thread while it calls.
  Tick tick_{nullptr, nullptr};
  std::int64_t begin_ns_ = 0;  ///< when it was opened: the zero of all sample times
  DeviceSample sample_{};
  int farewells_ = 0;

  // Shared between threads.
  std::atomic<bool> running_{false}, stopping_{false}, inside_{false}, ended_{true};
  std::atomic<std::thread::id> ticking_thread_{};
  std::atomic<std::int64_t> last_call_{0};
  std::atomic<std::uint64_t> ticks_{0};
  std::atomic<Ending> ending_{Ending::none};
  std::atomic<std::uint32_t> error_code_{0};
  std::atomic<int> error_internal_{0};
  hd::Warnings warnings_;
};

}  // namespace punctura
