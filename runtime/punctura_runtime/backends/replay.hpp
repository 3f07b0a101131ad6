// A recorded motion as a device, to run it with another scene or solver, or to show it.
#pragma once

#include <atomic>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura_runtime/backends/polled_device.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

struct ReplayOptions {
  bool real_time = true;  ///< one sample a period of the recorded rate; false: as fast as possible
  os::RealtimeSettings realtime{};
};

/// Ticks every recorded sample, unchanged, and ends by itself. The force has no effect on the motion.
///
/// Samples keep their recorded times, so that the input gate checks the recording and not the timing of the replay: the
/// same scene and limits give the recorded forces, bit for bit. After a delay, the replay continues where it was.
class ReplayDevice : public PolledDevice {
 public:
  /// recorded: the samples' device; its rate is that of the replay. Throws DeviceError if the rate is not above 0.
  ReplayDevice(std::vector<DeviceSample> samples, DeviceInfo recorded, const ReplayOptions& options = {});
  ~ReplayDevice() override { stop(); }

  LongestSilence longest_silence() const noexcept override { return LongestSilence::any(); }
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

  std::size_t size() const noexcept { return samples_.size(); }  ///< samples
  std::uint64_t behind() const noexcept { return missed(); }     ///< the delay so far, in periods: no sample is skipped

 private:
  void begin() override { unhealthy_ = false; }
  Next read() noexcept override;
  Next write(const Tick::Force&) noexcept override { return Next::tick; }
  void end() noexcept override {}

  std::vector<DeviceSample> samples_;
  std::atomic<bool> unhealthy_{false};
};

}  // namespace punctura
