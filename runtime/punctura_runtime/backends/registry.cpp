#include "punctura_runtime/backends/registry.hpp"

#include <cmath>
#include <exception>

namespace punctura {

namespace {

const Backend* const table[] = {
    &backends::openhaptics, &backends::force_dimension, &backends::haply, &backends::replay, &backends::simulated,
};

}  // namespace

std::vector<BackendStatus> enumerate_devices() {
  std::vector<BackendStatus> all;
  for (const Backend* backend : table) {
    try {
      all.push_back(backend->status());
    } catch (const std::exception& error) {  // one that fails must not hide the others
      all.push_back({backend->name, BackendStatus::State::fault, error.what(), {}});
    }
  }
  return all;
}

std::shared_ptr<Device> open_device(const std::string& backend, const OpenOptions& options) {
  if (!(options.rate > 0) || !std::isfinite(options.rate))
    throw DeviceError("a rate of " + std::to_string(options.rate) + " Hz cannot be asked for: it must be above 0");
  std::string known;
  for (const Backend* candidate : table) {
    if (backend == candidate->name) return candidate->open(options);
    known += (known.empty() ? "" : ", ") + std::string(candidate->name);
  }
  throw DeviceError("no back-end is called '" + backend + "'; there are " + known);
}

}  // namespace punctura
