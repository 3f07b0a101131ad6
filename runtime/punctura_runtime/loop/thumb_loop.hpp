// A second device under the thumb: its own ticks, one model and one safety state with the needle's loop.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>

#include "punctura/device/device.hpp"
#include "punctura/servo/thumb_step.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

struct ThumbSettings {
  Vector3d direction{0, -1, 0};  ///< in which the thumb pushes, of any length except 0
  GateLimits gate{};
  ForceLimits limits{};
  std::int64_t (*now_ns)() noexcept = os::now_ns;  ///< tests replace it
};

/// Runs the thumb's device. A ServoLoop owns one and starts, stops and resets it with itself.
///
/// The two ticks exchange single numbers through atomics and never wait for each other. The needle's tick reads the
/// thumb's depth and writes the plunger's force. The thumb's tick reads this force and writes the depth. So the force
/// is at most one tick of each loop old.
///
/// A fault of either device ends the force of both. Each side also takes silence of the other for a fault: the needle's
/// loop as a fault of the thumb, the thumb's loop by giving no force.
class ThumbLoop {
 public:
  /// The device's ratings tighten the limits. Throws std::invalid_argument if direction is 0 or a limit is wrong.
  explicit ThumbLoop(std::shared_ptr<Device> device, const ThumbSettings& settings = {});
  ~ThumbLoop();
  ThumbLoop(const ThumbLoop&) = delete;
  ThumbLoop& operator=(const ThumbLoop&) = delete;

  Device& device() noexcept { return *device_; }
  const GateLimits& gate() const noexcept { return settings_.gate; }
  const ForceLimits& limits() const noexcept { return settings_.limits; }

  void start();  ///< Throws DeviceError, also if another loop runs it
  void stop() noexcept;
  void reset() noexcept;  ///< clears a fault; the thumb's next place is where the plunger starts

  /// For the needle's tick. The thumb's depth, m; NaN in a fault and if the device is silent. 0 before the first tick,
  /// which has a second to come.
  double depth() const noexcept;
  /// For the needle's tick. force: of the plunger on the thumb, N. active: whether the needle's device gets force.
  void give(double force, bool active) noexcept;

  Fault fault() const noexcept { return fault_.load(std::memory_order_acquire); }
  double force() const noexcept { return felt_.load(std::memory_order_relaxed); }  ///< given to the thumb, N
  std::uint64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }

 private:
  static Tick::Force call(void* self, const DeviceSample& sample) noexcept;
  Tick::Force tick(const DeviceSample& sample) noexcept;
  bool recent(const std::atomic<std::int64_t>& last) const noexcept;

  std::shared_ptr<Device> device_;
  ThumbSettings settings_;
  ThumbStep step_;  ///< used by the ticking thread
  std::atomic<bool> running_{false};
  static constexpr std::int64_t first_tick_ns = 1'000'000'000;

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();
  std::atomic<std::uint32_t> resets_{0}, resets_done_{0};  ///< counted, so that no reset is lost during a tick
  std::atomic<bool> active_{false};
  std::atomic<std::int64_t> reset_at_{0};  ///< ns
  std::atomic<double> depth_{not_given}, plunger_force_{0}, felt_{0};
  std::atomic<Fault> fault_{Fault::none};
  std::atomic<std::int64_t> last_tick_{never}, last_given_{never};
  std::atomic<std::uint64_t> ticks_{0};
};

}  // namespace punctura
