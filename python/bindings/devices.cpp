// runtime: lists and opens devices, also the one under the thumb.

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string_view.h>

#include "bindings.hpp"
#include "punctura_runtime/backends/registry.hpp"
#include "punctura_runtime/loop/thumb_loop.hpp"
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
  return open_device(backend, {rate, device, library, {.priority = priority, .processor = processor}});
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

void bind_thumb(nb::module_& m) {
  auto thumb = nb::class_<ThumbLoop>(m, "ThumbLoop",
                                     "A second device, whose thumb holds the plunger of the scene's syringe.\n\n"
                                     "Pass it to a ServoLoop, which starts, stops and resets it. docs/syringe.md");
  def_repr(thumb, "<ThumbLoop on {0.device}: {0.fault.name}, {0.ticks} ticks>");
  thumb
      .def(
          "__init__",
          [](ThumbLoop* self, std::shared_ptr<Device> device, const Triple& direction, const GateLimits& gate,
             const ForceLimits& limits) {
            new (self) ThumbLoop(std::move(device), {unit(direction, "direction"), gate, limits});
          },
          nb::arg("device"), nb::arg("direction") = Triple{0, -1, 0}, nb::arg("gate") = GateLimits{},
          nb::arg("limits") = ForceLimits{},
          "direction: in which the thumb pushes, of any length but 0. The device's force ratings tighten the limits.\n"
          "Raises ConfigurationError, ValueError.")
      .def_prop_ro("device", &ThumbLoop::device, nb::rv_policy::reference_internal)
      .def_prop_ro("limits", &ThumbLoop::limits, nb::rv_policy::copy,
                   "The force limits in effect, device ratings included.")
      .def_prop_ro("depth", &ThumbLoop::depth, "Depth of the thumb, m; NaN in a fault and if the device is silent")
      .def_prop_ro("force", &ThumbLoop::force, "Force given to the thumb after all limits, N, negative while it pushes")
      .def_prop_ro("fault", &ThumbLoop::fault, "The latched fault of this device")
      .def_prop_ro("ticks", &ThumbLoop::ticks, "Number of ticks so far");
}

}  // namespace punctura::bindings
