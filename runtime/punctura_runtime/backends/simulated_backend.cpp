// The simulated device in the registry: always available; its hand follows a target.
#include "punctura_runtime/backends/backend.hpp"
#include "punctura_runtime/backends/simulated.hpp"

namespace punctura {

namespace {

BackendStatus simulated_status() {
  return {"simulated", BackendStatus::State::available, "A simulated PHANTOM Omni: no hardware.", {"PHANTOM Omni"}};
}

std::shared_ptr<Device> open_simulated(const OpenOptions& how) {
  SimulatedOptions options;
  options.rate = how.rate;
  options.realtime = how.realtime;
  return std::make_shared<SimulatedDevice>(Target({0, 5e-3, 0}), options);
}

}  // namespace

const Backend backends::simulated{"simulated", &simulated_status, &open_simulated};

}  // namespace punctura
