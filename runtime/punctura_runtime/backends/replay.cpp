#include "punctura_runtime/backends/replay.hpp"

#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

ReplayDevice::ReplayDevice(std::vector<DeviceSample> samples, DeviceInfo recorded, const ReplayOptions& options)
    : samples_(std::move(samples)) {
  info_ = std::move(recorded);
  pacing_ = {options.real_time, options.real_time, options.realtime};
  require_rate(info_.rate, "the rate of a recording");
  // Everything else is the recorded device's: its ratings limit the force, its encoder step selects the conditioning.
  if (info_.backend != "replay") info_.model = info_.model.empty() ? "a recorded motion" : info_.model + ", recorded";
  info_.backend = "replay";
}

std::string ReplayDevice::trouble() const {
  return unhealthy_ ? "the recorded device reported a fault of its own here" : "";
}

std::vector<std::string> ReplayDevice::statements() const {
  std::vector<std::string> all{"the force has no effect on a recorded motion"};
  if (const std::uint64_t periods = behind(); periods > 0)
    all.push_back("the replay is " + std::to_string(periods) + " periods late in total; no sample is missing");
  return with_priorities(std::move(all));
}

ReplayDevice::Next ReplayDevice::read() noexcept {
  if (count() == samples_.size()) return Next::end;
  sample_ = samples_[count()];
  if (!sample_.healthy) unhealthy_ = true;
  return Next::tick;
}

/// In the registry: always listed, but it needs a recording.
namespace {

BackendStatus replay_status() {
  return {"replay",
          BackendStatus::State::no_device,
          "A recorded motion in place of a hand. It needs a recording: punctura run SCENE --headless --device "
          "replay:FILE.parquet.",
          {}};
}

/// Recordings are Parquet and Arrow files, which only Python reads.
std::shared_ptr<Device> open_replay(const OpenOptions&) {
  throw DeviceError(
      "a recording is opened by `--device replay:FILE.parquet` or punctura.record.replay_device(FILE) in Python; "
      "in C++, give its samples to ReplayDevice");
}

}  // namespace

const Backend backends::replay{"replay", &replay_status, &open_replay};

}  // namespace punctura
