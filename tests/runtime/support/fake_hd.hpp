// The tests' access to the fake HD library, the same instance that the back-end loads.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "fakes/hd/fake_hd.h"
#include "punctura_runtime/backends/openhaptics/openhaptics.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura::test {

/// The functions that the fake exports for tests.
struct FakeHdControls {
  std::string error;
  void* library = os::load_library(FAKE_HD, error);
  template <typename Function>
  Function* find(const char* name) const {
    void* symbol = library ? os::library_symbol(library, name) : nullptr;
    REQUIRE_MESSAGE(symbol, error);
    return reinterpret_cast<Function*>(symbol);
  }
  decltype(&fake_hd_defaults) defaults = find<decltype(fake_hd_defaults)>("fake_hd_defaults");
  decltype(&fake_hd_reset) reset = find<decltype(fake_hd_reset)>("fake_hd_reset");
  decltype(&fake_hd_restart) restart = find<decltype(fake_hd_restart)>("fake_hd_restart");
  decltype(&fake_hd_inject) inject = find<decltype(fake_hd_inject)>("fake_hd_inject");
  decltype(&fake_hd_ticks) ticks = find<decltype(fake_hd_ticks)>("fake_hd_ticks");
  decltype(&fake_hd_now_ns) now_ns = find<decltype(fake_hd_now_ns)>("fake_hd_now_ns");
  decltype(&fake_hd_records) records = find<decltype(fake_hd_records)>("fake_hd_records");
  decltype(&fake_hd_held_force) held_force = find<decltype(fake_hd_held_force)>("fake_hd_held_force");
  decltype(&fake_hd_scheduler_runs) scheduler_runs = find<decltype(fake_hd_scheduler_runs)>("fake_hd_scheduler_runs");
  decltype(&fake_hd_operations) operations = find<decltype(fake_hd_operations)>("fake_hd_operations");
  decltype(&fake_hd_devices_open) devices_open = find<decltype(fake_hd_devices_open)>("fake_hd_devices_open");
  decltype(&fake_hd_misuses) misuses = find<decltype(fake_hd_misuses)>("fake_hd_misuses");
};

inline const FakeHdControls& fake_hd() {
  static const FakeHdControls controls;
  return controls;
}

/// Settings: as fast as possible, with a simulated clock. `change` may change them.
template <typename Change>
void reset_fake_hd(Change&& change) {
  fake_hd_settings settings;
  fake_hd().defaults(&settings);
  settings.fast_ticks = ~0ull;
  change(settings);
  fake_hd().reset(&settings);
}
inline void reset_fake_hd() {
  reset_fake_hd([](fake_hd_settings&) {});
}

inline OpenHapticsOptions with_fake_hd(double rate = 1600) {
  OpenHapticsOptions options;
  options.rate = rate;
  options.library = FAKE_HD;
  options.patience = 60;  // the computer may be busy
  options.now_ns = []() noexcept -> std::int64_t { return fake_hd().now_ns(); };
  return options;
}

/// Waits until the fake has made this many ticks; fails after a minute.
inline void until_tick(unsigned long long tick) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (fake_hd().ticks() < tick && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  REQUIRE(fake_hd().ticks() >= tick);
}

inline std::vector<fake_hd_record> fake_hd_log() {
  std::vector<fake_hd_record> records(65536);
  records.resize(fake_hd().records(records.data(), records.size()));
  return records;
}

inline std::array<double, 3> held_force() {
  std::array<double, 3> force{};
  fake_hd().held_force(force.data());
  return force;
}

}  // namespace punctura::test
