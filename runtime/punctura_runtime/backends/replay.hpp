// A recorded motion as a device: what was in a hand once, through another scene, another solver, or in front of a view.
#pragma once

#include <atomic>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/ticking_thread.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

struct ReplayOptions {
  bool real_time = true;  ///< one sample a period of the recorded rate; false: as fast as possible
  os::RealtimeSettings realtime{};
};

/// Ticks recorded samples, each as it was and none left out, and ends by itself. A recording does not yield: the force goes nowhere.
///
/// Samples keep the time at which they were recorded, so that the input gate judges the recording and not the punctuality of its
/// replay: the scene and the limits of the recording give its forces again, to the last bit. A replay that is held up goes on
/// where it was, later.
class ReplayDevice : public Device {
 public:
  /// recorded: the device that the samples are from; its rate is that of the replay. Throws DeviceError where that is none.
  ReplayDevice(std::vector<DeviceSample> samples, DeviceInfo recorded, const ReplayOptions& options = {});
  ~ReplayDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;  ///< from the first sample on
  void stop() noexcept override;
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

  bool finished() const noexcept { return finished_; }           ///< the last sample has been
  std::size_t size() const noexcept { return samples_.size(); }  ///< samples
  std::uint64_t behind() const noexcept { return behind_; }      ///< periods by which it has been held up so far

 private:
  void run(Tick tick) noexcept;

  std::vector<DeviceSample> samples_;
  DeviceInfo info_;
  ReplayOptions options_;
  std::atomic<bool> finished_{false}, unhealthy_{false};
  std::atomic<std::uint64_t> behind_{0};
  TickingThread thread_;
};

}  // namespace punctura
