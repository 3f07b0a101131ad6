// Force Dimension's omega, delta, sigma and lambda, and the Novint Falcon, as devices.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/backends/force_dimension/axes.hpp"
#include "punctura_runtime/backends/force_dimension/connection.hpp"
#include "punctura_runtime/backends/force_dimension/library.hpp"
#include "punctura_runtime/backends/ticking_thread.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura::force_dimension {

/// The clock of the ticks. Tests replace it.
struct LoopClock {
  std::int64_t (*now_ns)() noexcept = os::now_ns;
  void (*sleep_until_ns)(std::int64_t) noexcept = os::sleep_until_ns;

  std::int64_t now() const noexcept { return now_ns(); }
  void sleep_until(std::int64_t time) const noexcept { sleep_until_ns(time); }
};

inline constexpr double fastest = 4000;  ///< Hz: the maker's rating for USB

struct Options {
  double rate = usual_rate;  ///< Hz, at most `fastest`
  std::string device;        ///< label, model or serial number; empty is the first
  std::string library;       ///< see load()
  Triple tool{-1, 0, 0};     ///< direction of the needle in the axes of the handle; any length but 0
  bool auto_init = false;    ///< lets an uncalibrated device calibrate itself: THE ARM MOVES
  LoopClock clock{};
  os::RealtimeSettings realtime{};
};

/// Punctura paces: read, tick, write, in every period. Zero forces are written, too: the library compensates gravity
/// only with a write.
///
/// The maker's safety functions (velocity threshold, watchdog, brakes) are not changed. When the device switches its
/// force off, it stays off until stop() and start().
class ForceDimensionDevice : public Device {
 public:
  /// Opens it. Throws DeviceError.
  explicit ForceDimensionDevice(Options options);
  ~ForceDimensionDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;  ///< opens it again after stop()
  void stop() noexcept override;   ///< zero force, force off, closed
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

  bool finished() const noexcept { return finished_; }             ///< ticks have ended, by stop() or by a fault
  std::uint64_t saturated() const noexcept { return saturated_; }  ///< ticks with less force than requested
  std::uint64_t repeated() const noexcept { return repeated_; }    ///< readings that were not new
  std::uint64_t missed() const noexcept { return missed_; }        ///< skipped ticks

 private:
  enum class Trouble : int { none, reading, writing, force_off, force_never_on, calibration_lost, controller };

  void open();
  void run(Tick tick) noexcept;
  bool one_tick(Tick tick, double time) noexcept;
  bool read() noexcept;
  bool watch(double time) noexcept;
  bool switch_on() noexcept;
  void silence() noexcept;
  void fail(Trouble what, int code) noexcept;

  Options options_;
  Loaded library_;
  DeviceInfo info_;
  std::optional<Connection> connection_;
  char id_ = 0;

  // Used by the ticking thread only.
  DeviceSample sample_{};
  std::uint64_t ticks_ = 0, status_every_ = 1;
  bool force_seen_ = false, error_at_start_ = false;

  std::atomic<Trouble> trouble_{Trouble::none};
  std::atomic<int> code_{0};
  std::atomic<std::uint64_t> saturated_{0}, repeated_{0}, missed_{0};
  std::atomic<bool> finished_{false};
  TickingThread thread_;
};

}  // namespace punctura::force_dimension
