// core/punctura/safety and device: force limits, faults, and the description of a device.
#include "bindings.hpp"
#include "punctura/device/device.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/passivity.hpp"
#include "punctura/servo/snapshot.hpp"
#include "struct.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

constexpr std::tuple device_rows{
    row("backend", &DeviceInfo::backend),
    row("model", &DeviceInfo::model),
    row("serial", &DeviceInfo::serial),
    row("has_orientation", &DeviceInfo::has_orientation),
    row("button_count", &DeviceInfo::button_count),
    row("max_force", &DeviceInfo::max_force, "Peak force, N."),
    row("continuous_force", &DeviceInfo::continuous_force, "Continuous force, N."),
    row("max_stiffness", &DeviceInfo::max_stiffness, "N/m."),
    row("encoder_step", &DeviceInfo::encoder_step, "m."),
    row("rate", &DeviceInfo::rate, "Servo rate, Hz."),
};

}  // namespace

void bind_limits(nb::module_& m) {
  def_words<Fault>(m, "Fault", "The reason why a tick gave no force.");
  m.def("describe", &describe, nb::arg("fault"), "The meaning of a fault, and the remedy.");

  def_words<ServoState>(m, "ServoState", "Whether the device gets force.",
                        {"The model runs, the device gets no force.",
                         "Armed, but the tip is in tissue or no dead-man button is held. No force.",
                         "The device gets force, ramped up after arming.", "A fault is latched. The force is zero."});
  def_words<Limit>(m, "Limit", "The limit that reduced the force of a tick.",
                   {"The model's full force is sent.", "The force is still ramping up after arming.", "max_force.",
                    "The budget of continuous_force is used up.", "The device reports warm motors."});

  def_struct<gate_rows>(m, {"GateLimits", "Limits that a device reading must meet before the model uses it.", "gate"});
  def_struct<limit_fields>(m, {"ForceLimits", "Limits on the force sent to a device.", "limits"});

  m.def("lasting_force", &lasting_force, nb::arg("limits"),
        "The largest force that the limits permit for any time, N.");
  m.def(
      "largest_force", [](const Scene& scene) { return largest_force(build_insertion(scene)); }, nb::arg("scene"),
      "The largest friction along a needle that goes straight through all membranes, in and out, N: all membranes\n"
      "together. The needle points along the first membrane's inward normal.");
  m.def(
      "needed_damping", &needed_damping, nb::arg("scene"),
      "The viscous damping of a device, N s/m, above which it is passive in any grip while every membrane holds the\n"
      "needle, for a force scale of 1. Behind a line fit it is that of the worst window. Colgate and Schenkel (1997).");
  m.def(
      "force_scale",
      [](const Scene& scene, const ForceLimits& limits) { return force_scale(scene, build_insertion(scene), limits); },
      nb::arg("scene"), nb::arg("limits"),
      "How much of the model's force a device with these limits gives: the scene's own number, or the automatic one.");

  def_struct<placement_rows>(
      m,
      {"Placement",
       "The device's pose in the scene: point = rotation * (scale * device point) + offset + tip_offset * axis."},
      [](const Placement& made, std::vector<Problem>& problems) { problems = check(made); });

  auto info =
      StructOf<device_rows>::define<DeviceInfo>(m,
                                                {.name = "DeviceInfo",
                                                 .doc = "What a device says of itself; NaN where it does not say.",
                                                 .raises = "An omitted value is unknown.",
                                                 .needed = 0},
                                                unchecked, nb::kw_only());
  def_repr(info, StructOf<device_rows>::names());
}

}  // namespace punctura::bindings
