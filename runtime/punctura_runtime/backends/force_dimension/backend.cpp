// Force Dimension's devices in the registry.
#include "punctura_runtime/backends/force_dimension/device.hpp"

namespace punctura {

namespace {

using namespace force_dimension;
constexpr const char* name = "force_dimension";

BackendStatus status() {
  using State = BackendStatus::State;
  const Loaded library = load();
  if (library.state != State::available) return {name, library.state, library.detail, {}};
  try {
    const Survey found = survey(library.api);
    const std::string by = " By " + library.path + ".";
    if (!found.ready.empty())
      return {name, State::available, joined(found.ready) + ": can be opened." + by, found.ready};
    if (!found.uncalibrated.empty())
      return {name, State::needs_calibration, calibration_advice(found.uncalibrated.front()) + by, found.uncalibrated};
    const Refusal& why = found.refusals.front();
    return {name, why.state, std::string(why.what()) + "." + by, {}};
  } catch (const Refusal& why) {
    return {name, why.state, why.what(), {}};
  }
}

std::shared_ptr<Device> open(const OpenOptions& how) { return std::make_shared<ForceDimensionDevice>(Options{how}); }

}  // namespace

const Backend backends::force_dimension{name, &status, &open};

}  // namespace punctura
