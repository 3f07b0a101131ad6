// The plant as a device, for users without hardware and for tests of the loop.
#pragma once

#include <atomic>
#include <memory>
#include <variant>

#include "punctura/device/device.hpp"
#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/backends/polled_device.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/handover.hpp"

namespace punctura {

struct SimulatedOptions {
  DeviceDynamics dynamics{};
  Hand hand{};
  double rate = usual_rate;  ///< Hz
  std::uint64_t seed = 0;
  bool real_time = true;                 ///< false: as fast as possible, on a clock of its own
  std::uint64_t ticks = 0;               ///< number of ticks; 0 is endless
  std::array<double, 3> axis{0, -1, 0};  ///< direction of the stylus
  os::RealtimeSettings realtime{};
};

/// A simulated PHANTOM Omni in a simulated hand that makes strokes, repeats a recorded motion, or follows a target.
class SimulatedDevice : public PolledDevice {
 public:
  using Motion = std::variant<StrokesMotion, RecordedMotion, Target>;

  SimulatedDevice(Motion motion, const SimulatedOptions& options);
  ~SimulatedDevice() override { stop(); }

  LongestSilence longest_silence() const noexcept override { return LongestSilence::any(); }

  /// Sets the position that a Target's hand moves to, m. At any time, from one thread at a time.
  void move_to(const std::array<double, 3>& position) noexcept;
  /// Sets the direction of the stylus and the pressed buttons. From the same thread.
  void point(const std::array<double, 3>& axis, std::uint32_t buttons = 0) noexcept;

  /// Test aid: changes the next reading once, to provoke a fault.
  void spoil(void (*how)(DeviceSample&)) noexcept { spoiler_.store(how); }
  /// Test aid: the last force on the plant, N.
  std::array<double, 3> last_force() noexcept { return last_force_.read(); }

 private:
  struct Wish {
    std::array<double, 3> target, axis;
    std::uint32_t buttons = 0;
  };
  Next read() noexcept override;
  Next write(const Tick::Force& force) noexcept override;
  void end() noexcept override;

  std::uint64_t ticks_;
  Motion motion_;
  Plant plant_;
  Desired desired_{};
  Wish wish_;
  TripleBuffer<Wish> wishes_;
  TripleBuffer<std::array<double, 3>> last_force_;
  std::atomic<void (*)(DeviceSample&)> spoiler_{nullptr};
};

}  // namespace punctura
