// runtime/backends: which devices there are, and opening one.
#include <nanobind/stl/shared_ptr.h>

#include "bindings.hpp"
#include "punctura_runtime/backends/registry.hpp"

namespace punctura::bindings {
namespace {

nb::list enumerated() {
  std::vector<BackendStatus> all;
  {
    nb::gil_scoped_release release;
    all = enumerate_devices();
  }
  nb::list list;
  for (const BackendStatus& status : all) {
    nb::dict d;
    d["backend"] = status.backend;
    d["state"] = name_of(status.state);
    d["detail"] = status.detail;
    d["devices"] = status.devices;
    list.append(d);
  }
  return list;
}

std::shared_ptr<Device> opened(const std::string& backend, double rate, const std::string& device,
                               const std::string& library, int priority, int processor) {
  nb::gil_scoped_release release;
  OpenOptions options{rate, device, library};
  options.realtime.priority = priority;
  options.realtime.processor = processor;
  return open_device(backend, options);
}

}  // namespace

void bind_devices(nb::module_& m) {
  m.def("enumerate_devices", &enumerated, nb::sig("def enumerate_devices() -> list[dict[str, typing.Any]]"),
        "Of each back-end a dict: backend, state (available, library_not_found, symbol_missing, no_device, in_use,\n"
        "needs_calibration, fault), detail (in words: where it looked, what to do), devices. Gives no force.");
  const OpenOptions options;
  m.def(
      "open_device", &opened, nb::arg("backend"), nb::arg("rate") = options.rate, nb::arg("device") = options.device,
      nb::arg("library") = options.library, nb::arg("priority") = options.realtime.priority,
      nb::arg("processor") = options.realtime.processor,
      "rate: Hz, wished for; the device's info says what came of it. device: which one, as its maker names it. library: path\n"
      "of the maker's library. priority: of real-time scheduling, 0 asks for none. processor: the one to tick on, -1 is any\n"
      "(both where the thread is not the maker's own). Raises DeviceError, which says what to do.");
}

}  // namespace punctura::bindings
