// The plant as a device: for those who have no hardware, and for every test of the loop.
#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <variant>

#include "punctura/device/device.hpp"
#include "punctura/model/omni.hpp"
#include "punctura/plant/motion.hpp"
#include "punctura/plant/plant.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/latest.hpp"
#include "punctura_runtime/ring/milestone.hpp"

namespace punctura {

struct SimulatedOptions {
  DeviceDynamics dynamics{};
  Hand hand{};
  double rate = usual_rate;  ///< Hz
  std::uint64_t seed = 0;
  bool real_time = true;                 ///< false: as fast as possible, on a clock of its own
  std::uint64_t ticks = 0;               ///< how many ticks there are; 0 is no end
  std::array<double, 3> axis{0, -1, 0};  ///< where the stylus points
  os::RealtimeSettings realtime{};
};

/// A simulated PHANTOM Omni in a simulated hand that makes strokes, repeats a recorded motion, or follows a target.
class SimulatedDevice : public Device {
 public:
  using Motion = std::variant<StrokesMotion, RecordedMotion, Target>;

  SimulatedDevice(Motion motion, const SimulatedOptions& options);
  ~SimulatedDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  std::vector<std::string> statements() const override;

  /// Of a Target: where the hand shall go, m. From one thread at a time, at any moment.
  void move_to(const std::array<double, 3>& position) noexcept;
  /// Where the stylus points, and the buttons that are held. From the same thread.
  void point(const std::array<double, 3>& axis, std::uint32_t buttons = 0) noexcept;
  bool finished() const noexcept { return finished_; }  ///< all ticks asked for have been
  std::uint64_t missed() const noexcept { return missed_; }

  /// The next reading is spoilt by this, once: to try what a fault is like.
  void spoil(void (*how)(DeviceSample&)) noexcept { spoiler_.store(how); }
  /// Test aid: the force that the plant was given last, N.
  std::array<double, 3> last_force() noexcept { return last_force_.read(); }

 private:
  struct Wish {
    std::array<double, 3> target, axis;
    std::uint32_t buttons = 0;
  };
  void run(Tick tick) noexcept;
  void one_tick(Tick tick, std::uint64_t k, double time) noexcept;

  SimulatedOptions options_;
  DeviceInfo info_;
  Motion motion_;
  Plant plant_;
  Wish wish_;
  Latest<Wish> wishes_;
  Latest<std::array<double, 3>> last_force_;
  std::atomic<void (*)(DeviceSample&)> spoiler_{nullptr};
  std::atomic<bool> stop_{false}, finished_{false};
  Milestone ready_;
  std::atomic<std::uint64_t> missed_{0};
  std::vector<os::RealtimeItem> realtime_;
  std::thread thread_;
};

}  // namespace punctura
