// A Haply Inverse3 behind the Inverse Service: we ask, it answers; each question carries a force, each answer a position.
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/backends/inverse/service.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/milestone.hpp"

namespace punctura::inverse {

struct InverseOptions {
  std::string url = default_url();
  std::string device;        ///< its device_id; empty is the first
  double rate = usual_rate;  ///< Hz, wished for; the service's round trip may allow less
  double max_force = 5;      ///< N. Its maker publishes no limit; this is the cautious one of those in use
  double stale = 0.015;      ///< s that an answer may take
  double no_grip = 0.25;     ///< s that a grip may be missing from the answers
  bool real_time = true;     ///< false: as fast as answers come, on a clock of its own
  os::RealtimeSettings realtime{};
  std::int64_t (*now_ns)() noexcept =
      os::now_ns;  ///< what the rate is measured by; tests put a clock of their own here
};

class InverseDevice : public Device {
 public:
  /// Connects, finds out how the service wants its force, and measures how often it answers. Throws DeviceError.
  explicit InverseDevice(InverseOptions options);
  ~InverseDevice() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override;
  void stop() noexcept override;
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

 private:
  /// Why ticks have ceased.
  enum class Trouble : std::uint8_t {
    none,
    no_answer,
    closed,
    not_json,
    broken,
    too_big,
    failed,
    gone,
    no_position,
    unready,
    no_grip
  };

  void open();
  double measured_rate();
  void run(Tick tick) noexcept;
  Trouble next(const Tick::Force& force) noexcept;
  Trouble read(DeviceSample& sample) noexcept;
  Vector bounded(const Tick::Force& force) const noexcept;

  InverseOptions options_;
  Url url_;
  DeviceInfo info_;
  Service service_;
  bool paced_ = true, was_in_use_ = false;
  double fastest_ = unknown;    ///< round trips a second
  std::uint64_t gripless_ = 0;  ///< answers in a row without a grip
  std::vector<os::RealtimeItem> realtime_;
  std::atomic<bool> stop_{false}, running_{false};
  Milestone ready_;
  std::atomic<Trouble> trouble_{Trouble::none};  ///< close_reason() may be read once this says why
  std::thread thread_;
};

}  // namespace punctura::inverse
