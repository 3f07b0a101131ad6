// Force Dimension's omega, delta, sigma and lambda, and the Novint Falcon, as devices.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/force_dimension/connection.hpp"
#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"
#include "punctura_runtime/backends/polled_device.hpp"

namespace punctura::force_dimension {

using Triple = std::array<double, 3>;

/// A position, a direction or a force of the device in Punctura's axes.
constexpr Triple to_ours(const Triple& device) noexcept { return {device[1], device[2], device[0]}; }

/// The inverse rotation.
constexpr Triple to_device(const Triple& ours) noexcept { return {ours[2], ours[0], ours[1]}; }

/// Rotates `tool` from the axes of the handle to those of the device. frame: rows of the handle's rotation matrix.
constexpr Triple turned(const double (&frame)[3][3], const Triple& tool) noexcept {
  Triple d{};
  for (int row = 0; row < 3; ++row)
    d[static_cast<unsigned>(row)] = frame[row][0] * tool[0] + frame[row][1] * tool[1] + frame[row][2] * tool[2];
  return d;
}

inline constexpr double fastest = 4000;  ///< Hz: the maker's rating for USB

/// rate: at most `fastest`. device: label, model or serial number. library: see load().
struct Options : OpenOptions {
  Triple tool{-1, 0, 0};   ///< direction of the needle in the axes of the handle; any length but 0
  bool auto_init = false;  ///< lets an uncalibrated device calibrate itself: THE ARM MOVES
  LoopClock clock{};
};

/// Zero forces are written, too: the library compensates gravity only with a write.
///
/// The maker's safety functions (velocity threshold, watchdog, brakes) are not changed. When the device switches its
/// force off, it stays off until stop() and start().
class ForceDimensionDevice : public PolledDevice {
 public:
  /// Opens it. Throws DeviceError.
  explicit ForceDimensionDevice(Options options);
  ~ForceDimensionDevice() override { stop(); }

  void stop() noexcept override;  ///< zero force, force off, closed; start() opens it again
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

  std::uint64_t saturated() const noexcept { return saturated_; }  ///< ticks with less force than requested
  std::uint64_t repeated() const noexcept { return repeated_; }    ///< readings that were not new

 private:
  enum class Trouble : int { none, reading, writing, force_off, force_never_on, calibration_lost, controller };

  void open();
  void begin() override;
  std::string prepare() noexcept override;
  Next read() noexcept override;
  Next write(const Tick::Force& force) noexcept override;
  void end() noexcept override;
  bool watch() noexcept;
  void fail(Trouble what, int code) noexcept;

  Options options_;
  Loaded library_;
  std::optional<Connection> connection_;
  char id_ = 0;

  // Used by the ticking thread only.
  std::uint64_t status_every_ = 1;
  bool force_seen_ = false, error_at_start_ = false;

  std::atomic<Trouble> trouble_{Trouble::none};
  std::atomic<int> code_{0};
  std::atomic<std::uint64_t> saturated_{0}, repeated_{0};
};

}  // namespace punctura::force_dimension
