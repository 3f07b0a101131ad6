// Force Dimension's omega, delta, sigma and lambda, and the Novint Falcon, as devices.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/backends/force_dimension/axes.hpp"
#include "punctura_runtime/backends/force_dimension/connection.hpp"
#include "punctura_runtime/backends/force_dimension/library.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/milestone.hpp"

namespace punctura::force_dimension {

/// The clock that ticks are counted on. Tests put one of their own in its place.
struct LoopClock {
  std::int64_t (*now_ns)() noexcept = os::now_ns;
  void (*sleep_until_ns)(std::int64_t) noexcept = os::sleep_until_ns;

  std::int64_t now() const noexcept { return now_ns(); }
  void sleep_until(std::int64_t time) const noexcept { sleep_until_ns(time); }
};

inline constexpr double fastest = 4000;  ///< Hz: what its maker gives for USB

struct Options {
  double rate = usual_rate;  ///< Hz, at most `fastest`
  std::string device;        ///< label, model or serial number; empty is the first
  std::string library;       ///< see load()
  Triple tool{-1, 0, 0};     ///< where the needle points, in the axes of the handle: a direction, not of length 0
  bool auto_init = false;    ///< a device without calibration may find it by itself: THE ARM MOVES
  LoopClock clock{};
  os::RealtimeSettings realtime{};
};

/// Our loop paces: read, tick, write, in every period; zeros are written too, since the library compensates gravity only then.
///
/// The maker's safety stays as it came: neither velocity threshold nor watchdog nor brakes are touched. When the device takes force
/// away (its button, its brakes, its watchdog), it stays away until stop() and start().
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

  bool finished() const noexcept { return finished_; }             ///< ticks have ceased, by stop() or by a fault
  std::uint64_t saturated() const noexcept { return saturated_; }  ///< forces that the motors could not give in full
  std::uint64_t repeated() const noexcept { return repeated_; }    ///< readings that were not new
  std::uint64_t missed() const noexcept { return missed_; }        ///< ticks left out

 private:
  enum class Trouble : int { none, reading, writing, force_off, force_never_on, calibration_lost, controller };

  void open();
  void run(Tick tick) noexcept;
  bool one_tick(Tick tick, double time) noexcept;
  bool read() noexcept;
  bool watch(double time) noexcept;
  void switch_on() noexcept;
  void silence() noexcept;
  void fail(Trouble what, int code) noexcept;

  Options options_;
  Loaded library_;
  DeviceInfo info_;
  std::optional<Connection> connection_;
  char id_ = 0;

  // Of the ticking thread.
  DeviceSample sample_{};
  std::uint64_t ticks_ = 0, status_every_ = 1;
  bool force_seen_ = false, error_at_start_ = false, refused_ = false;

  std::atomic<Trouble> trouble_{Trouble::none};
  std::atomic<int> code_{0};
  std::atomic<std::uint64_t> saturated_{0}, repeated_{0}, missed_{0};
  std::atomic<bool> stop_{false}, finished_{false};
  Milestone ready_;
  std::vector<os::RealtimeItem> realtime_;
  std::thread thread_;
};

}  // namespace punctura::force_dimension
