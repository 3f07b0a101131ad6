#include "punctura_runtime/backends/registry.hpp"

#include <algorithm>
#include <exception>
#include <mutex>

namespace punctura {

namespace {

/// The registered back-ends, then the built-in ones.
class Table {
 public:
  static std::vector<const Backend*> all() {
    const std::lock_guard lock(one().mutex_);
    return one().backends_;
  }
  static void add(const Backend& backend) {
    const std::lock_guard lock(one().mutex_);
    auto& known = one().backends_;
    const auto same = [&](const Backend* other) { return std::string(other->name) == backend.name; };
    if (std::any_of(known.begin(), known.end(), same))
      throw DeviceError("a back-end called '" + std::string(backend.name) + "' exists already");
    known.insert(known.begin(), &backend);
  }

 private:
  static Table& one() {
    static Table table;
    return table;
  }
  std::mutex mutex_;
  std::vector<const Backend*> backends_{&backends::openhaptics, &backends::force_dimension, &backends::haply,
                                        &backends::replay, &backends::simulated};
};

}  // namespace

void register_backend(const Backend& backend) { Table::add(backend); }

std::vector<BackendStatus> enumerate_devices() {
  std::vector<BackendStatus> all;
  for (const Backend* backend : Table::all()) {
    try {
      all.push_back(backend->status());
    } catch (const std::exception& error) {  // the others are listed all the same
      all.push_back({backend->name, BackendStatus::State::fault, error.what(), {}});
    }
  }
  return all;
}

std::shared_ptr<Device> open_device(const std::string& backend, const OpenOptions& options) {
  require_rate(options.rate);
  std::string known;
  for (const Backend* candidate : Table::all()) {
    if (backend == candidate->name) return candidate->open(options);
    known += (known.empty() ? "" : ", ") + std::string(candidate->name);
  }
  throw DeviceError("no back-end is called '" + backend + "'; available: " + known);
}

}  // namespace punctura
