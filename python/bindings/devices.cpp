// runtime/backends: lists and opens devices.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string_view.h>

#include "bindings.hpp"
#include "punctura_runtime/backends/registry.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

Object<"list[BackendState]"> enumerated() {
  std::vector<BackendStatus> all;
  {
    const WithoutLock release;
    all = enumerate_devices();
  }
  nb::list list;
  for (const BackendStatus& status : all) {
    nb::dict d;
    d["backend"] = status.backend;
    d["state"] = word_of(status.state);
    d["detail"] = status.detail;
    d["devices"] = status.devices;
    list.append(d);
  }
  return list;
}

std::shared_ptr<Device> opened(const std::string& backend, double rate, const std::string& device,
                               const std::string& library, int priority, int processor) {
  const WithoutLock release;
  OpenOptions options{rate, device, library};
  options.realtime = {.priority = priority, .processor = processor};
  return open_device(backend, options);
}

}  // namespace

void bind_devices(nb::module_& m) {
  m.def("enumerate_devices", &enumerated,
        "Lists the devices of all back-ends. Sends no force.\n\n"
        "Each back-end is a dict: backend, state (available, library_not_found, symbol_missing, no_device, in_use,\n"
        "needs_calibration, fault), detail (text: where it searched, what to do), devices.");
  const OpenOptions options;
  m.def("open_device", &opened, nb::arg("backend"), nb::arg("rate") = options.rate, nb::arg("device") = options.device,
        nb::arg("library") = options.library, nb::arg("priority") = options.realtime.priority,
        nb::arg("processor") = options.realtime.processor,
        "Opens a device.\n\n"
        "rate: requested rate, Hz; the device's info has the actual rate. device: its name as the maker gives it.\n"
        "library: path of the maker's library. priority: real-time scheduling priority, 0 for none. processor: CPU\n"
        "number, -1 for any. priority and processor have no effect if the maker's library owns the thread. Raises\n"
        "DeviceError, which says what to do.");
}

}  // namespace punctura::bindings
