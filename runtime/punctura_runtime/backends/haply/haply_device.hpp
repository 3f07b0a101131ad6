// A Haply Inverse3 behind the Inverse Service: each message to the service has a force, each answer a position.
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/haply/service.hpp"
#include "punctura_runtime/backends/polled_device.hpp"

namespace punctura::haply {

/// device: its device_id. rate: the service's round trip may allow less.
struct HaplyOptions : OpenOptions {
  std::string url = default_url();
  double max_force = 5;   ///< N. The maker publishes no limit; this is the lowest in public use
  double stale = 0.015;   ///< s: timeout of an answer
  double no_grip = 0.25;  ///< s for which a grip may be missing from the answers
  bool real_time = true;  ///< false: as fast as answers come, on a clock of its own
  std::int64_t (*now_ns)() noexcept = os::now_ns;  ///< the clock that measures the rate; tests replace it
};

class HaplyDevice : public PolledDevice {
 public:
  /// Connects, determines the format of the force, and measures the rate of the service. Throws DeviceError.
  explicit HaplyDevice(HaplyOptions options);
  ~HaplyDevice() override { stop(); }

  void stop() noexcept override;
  std::string trouble() const override;
  std::vector<std::string> statements() const override;

 private:
  /// Why ticks have ended.
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
  void begin() override;
  Next read() noexcept override;
  Next write(const Tick::Force& force) noexcept override;
  void end() noexcept override;
  Trouble exchange() noexcept;
  Trouble take() noexcept;

  HaplyOptions options_;
  Url url_;
  Service service_;
  bool was_in_use_ = false;
  double fastest_ = not_given;                   ///< round trips a second
  std::uint64_t gripless_ = 0;                   ///< answers in a row without a grip
  Tick::Force force_{};                          ///< of the last tick
  Trouble found_ = Trouble::none;                ///< by the ticking thread
  std::atomic<Trouble> trouble_{Trouble::none};  ///< once it is not `none`, close_reason() may be read
};

BackendStatus status_at(const std::string& url);

}  // namespace punctura::haply
