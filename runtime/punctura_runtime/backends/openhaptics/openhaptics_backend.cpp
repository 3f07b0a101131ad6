// OpenHaptics in the registry.
#include "punctura_runtime/backends/openhaptics/hd_library.hpp"
#include "punctura_runtime/backends/openhaptics/hd_trial.hpp"
#include "punctura_runtime/backends/openhaptics/openhaptics.hpp"

namespace punctura {

namespace {

constexpr const char* name = "openhaptics";

bool keep_device() {
  const std::string value = environment("PUNCTURA_HD_KEEP_DEVICE");
  return !value.empty() && value != "0";
}

BackendStatus status() {
  const hd::Loaded loaded = hd::load();
  if (!loaded.functions) return {name, loaded.state, loaded.detail, {}};
  try {
    const hd::Session session(*loaded.functions, "", keep_device());
    const DeviceInfo& info = session.info();
    if (session.tells_calibration()) hd::require_calibration(session.hd(), session.hd().check_calibration());
    return {
        name,
        BackendStatus::State::available,
        info.model + (info.serial.empty() ? "" : ", serial number " + info.serial) + ", through " + loaded.path + ".",
        {session.name()}};
  } catch (const Refusal& refused) {
    return {name, refused.state, refused.what() + std::string(" (Library: ") + loaded.path + ".)", {}};
  }
}

std::shared_ptr<Device> open(const OpenOptions& how) {
  OpenHapticsOptions options{how};
  options.keep_device = keep_device();
  return std::make_shared<OpenHapticsDevice>(options);
}

}  // namespace

const Backend backends::openhaptics{name, &status, &open};

}  // namespace punctura
