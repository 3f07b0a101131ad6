// What a back-end is to the registry: a name, what it says of itself, and how its device is opened.
#pragma once

#include <memory>
#include <string>

#include "punctura/device/device.hpp"
#include "punctura/model/omni.hpp"
#include "punctura_runtime/backends/status.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura {

struct OpenOptions {
  double rate = usual_rate;         ///< Hz, wished for: the device's `info().rate` says what came of it
  std::string device;               ///< which one, as its maker names it; empty is the first
  std::string library;              ///< path of the maker's library; empty looks where it usually is
  os::RealtimeSettings realtime{};  ///< of the thread that ticks, where that is ours and not a maker's
};

struct Backend {
  const char* name;
  BackendStatus (*status)();                                ///< moves nothing and gives no force
  std::shared_ptr<Device> (*open)(const OpenOptions& how);  ///< throws DeviceError
};

/// Ours: each is defined in its own file, and named once more in the table of registry.cpp. Others come by register_backend().
namespace backends {
extern const Backend openhaptics;
extern const Backend force_dimension;
extern const Backend haply;
extern const Backend replay;
extern const Backend simulated;
}  // namespace backends

}  // namespace punctura
