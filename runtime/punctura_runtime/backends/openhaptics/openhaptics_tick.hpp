// The part of the device that the scheduler's thread uses.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"
#include "punctura_runtime/backends/openhaptics/hd_session.hpp"

namespace punctura::hd {

/// Reads the device, calls the tick and sends its force, in every call of the scheduler.
class Ticking : public Work {
 public:
  enum class Ending { none, error, calibration };

  Ticking(const Session& session, std::int64_t (*now_ns)() noexcept);

  /// Before it is scheduled.
  void begin(Tick tick) noexcept;
  bool call() noexcept;  ///< by the scheduler
  /// The next call of the scheduler sends a frame of zeros and is the last.
  void stop_soon() noexcept { stopping_ = true; }
  /// As stop_soon(). When it returns, no tick runs any more. Not from the tick.
  void end() noexcept;
  /// True if it was sent.
  bool zero_frame() noexcept;

  std::atomic<bool> inside{false};  ///< a call
  std::atomic<bool> ended{true};    ///< the last frame of zeros is sent, or given up
  std::atomic<std::thread::id> thread{};
  std::atomic<std::int64_t> last_call{0};
  std::atomic<std::uint64_t> ticks{0};
  std::atomic<Ending> ending{Ending::none};
  std::atomic<std::uint32_t> error_code{0};
  std::atomic<int> error_internal{0};
  Warnings warnings;

 private:
  bool one_tick() noexcept;
  Tick::Force force() noexcept;
  ErrorInfo read() noexcept;
  void leave(Ending why, const ErrorInfo& error) noexcept;
  static constexpr std::uint64_t temperature_every = 64, calibration_every = 256;  ///< ticks
  static constexpr int most_farewells = 32;                                        ///< frames of zero force

  // Copies: the session may be closed while a call hangs.
  const Interface& hd_;
  DeviceHandle handle_;
  bool has_orientation_, tells_temperature_, tells_calibration_;
  std::int64_t (*now_ns_)() noexcept;
  std::int64_t begin_ns_;  ///< when the device was opened: the zero of all sample times

  std::atomic<bool> stopping_{false}, in_tick_{false};
  Tick tick_{};
  DeviceSample sample_{};
  int farewells_ = 0;
};

}  // namespace punctura::hd
