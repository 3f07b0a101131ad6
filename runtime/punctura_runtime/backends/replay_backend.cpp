// Replay in the registry: always listed, but it needs a recording.
#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

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
