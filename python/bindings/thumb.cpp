// The device under the thumb, for a scene with a syringe.
#include "punctura_runtime/loop/thumb_loop.hpp"

#include <nanobind/stl/shared_ptr.h>

#include "bindings.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {

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
            ThumbSettings settings;
            settings.direction = unit(direction, "direction");
            settings.gate = gate;
            settings.limits = limits;
            new (self) ThumbLoop(std::move(device), settings);
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
