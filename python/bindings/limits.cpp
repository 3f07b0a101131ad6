// core/punctura/safety and device: force limits, faults, and the description of a device.
#include "bindings.hpp"
#include "punctura/device/device.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/passivity.hpp"
#include "punctura/servo/snapshot.hpp"
#include "value.hpp"

namespace punctura::bindings {

void bind_limits(nb::module_& m) {
  nb::enum_<Fault>(m, "Fault", nb::is_arithmetic(), "The reason why a tick gave no force.")
      .value("none", Fault::none)
      .value("non_finite_input", Fault::non_finite_input)
      .value("bad_axis", Fault::bad_axis)
      .value("position_jump", Fault::position_jump)
      .value("stale_sample", Fault::stale_sample)
      .value("missed_deadline", Fault::missed_deadline)
      .value("clock", Fault::clock)
      .value("non_finite_force", Fault::non_finite_force)
      .value("device", Fault::device)
      .value("thumb", Fault::thumb);
  m.def("describe", &describe, nb::arg("fault"), "The meaning of a fault, and the remedy.");

  nb::enum_<ServoState>(m, "ServoState", nb::is_arithmetic(), "Whether the device gets force.")
      .value("disarmed", ServoState::disarmed, "The model runs, the device gets no force.")
      .value("waiting", ServoState::waiting, "Armed, but the tip is in tissue or no dead-man button is held. No force.")
      .value("active", ServoState::active, "The device gets force, ramped up after arming.")
      .value("faulted", ServoState::faulted, "A fault is latched. The force is zero.");

  nb::enum_<Limit>(m, "Limit", nb::is_arithmetic(), "The limit that reduced the force of a tick.")
      .value("none", Limit::none, "The model's full force is sent.")
      .value("ramp", Limit::ramp, "The force is still ramping up after arming.")
      .value("peak", Limit::peak, "max_force.")
      .value("continuous", Limit::continuous, "The budget of continuous_force is used up.")
      .value("temperature", Limit::temperature, "The device reports warm motors.");

  const GateLimits gate;
  auto gate_class =
      nb::class_<GateLimits>(m, "GateLimits", "Limits that a device reading must meet before the model uses it.")
          .def(
              "__init__",
              [](GateLimits* self, double speed, double stale, double deadline, double axis, std::uint32_t dead_man) {
                const GateLimits made{speed, stale, deadline, axis, dead_man};
                raise_if(check(made, ForceLimits{}));
                new (self) GateLimits(made);
              },
              nb::arg("max_speed") = gate.max_speed, nb::arg("stale") = gate.stale, nb::arg("deadline") = gate.deadline,
              nb::arg("axis_tolerance") = gate.axis_tolerance, nb::arg("dead_man") = gate.dead_man,
              "max_speed: m/s between two readings. stale: longest time without a new reading, s. deadline: longest\n"
              "time between ticks, s. axis_tolerance: deviation of the axis' length from 1. dead_man: buttons\n"
              "(bits), one of which must be held; 0 for none. Raises ConfigurationError.")
          .def_ro("max_speed", &GateLimits::max_speed, "m/s")
          .def_ro("stale", &GateLimits::stale, "s")
          .def_ro("deadline", &GateLimits::deadline, "s")
          .def_ro("axis_tolerance", &GateLimits::axis_tolerance)
          .def_ro("dead_man", &GateLimits::dead_man);
  def_value(gate_class, {"max_speed", "stale", "deadline", "axis_tolerance", "dead_man"});

  const ForceLimits limits;
  auto limits_class =
      nb::class_<ForceLimits>(m, "ForceLimits", "Limits on the force sent to a device.")
          .def(
              "__init__",
              [](ForceLimits* self, double max, double continuous, double time, double ramp, double warm) {
                const ForceLimits made{max, continuous, time, ramp, warm};
                raise_if(check(GateLimits{}, made));
                new (self) ForceLimits(made);
              },
              nb::arg("max_force") = limits.max_force, nb::arg("continuous_force") = limits.continuous_force,
              nb::arg("continuous_time") = limits.continuous_time, nb::arg("ramp_time") = limits.ramp_time,
              nb::arg("warm_motor") = limits.warm_motor,
              "max_force: norm, N. continuous_force: N rms over any continuous_time (s). ramp_time: time from zero\n"
              "to full force after arming, s. warm_motor: motor temperature (0 to 1) above which the force\n"
              "decreases, to zero at 1. Raises ConfigurationError.")
          .def_ro("max_force", &ForceLimits::max_force, "N")
          .def_ro("continuous_force", &ForceLimits::continuous_force, "N rms")
          .def_ro("continuous_time", &ForceLimits::continuous_time, "s")
          .def_ro("ramp_time", &ForceLimits::ramp_time, "s")
          .def_ro("warm_motor", &ForceLimits::warm_motor);
  def_value(limits_class, {"max_force", "continuous_force", "continuous_time", "ramp_time", "warm_motor"});

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

  const Placement nowhere;
  auto placement =
      nb::class_<Placement>(
          m, "Placement",
          "The device's pose in the scene: point = rotation * (scale * device point) + offset + tip_offset * axis.")
          .def(
              "__init__",
              [](Placement* self, const std::array<double, 4>& rotation, const Triple& offset, double scale,
                 double tip_offset) {
                const Placement made{rotation, offset, scale, tip_offset};
                raise_if(check(made));
                new (self) Placement(made);
              },
              nb::arg("rotation") = nowhere.rotation, nb::arg("offset") = nowhere.offset,
              nb::arg("scale") = nowhere.scale, nb::arg("tip_offset") = nowhere.tip_offset,
              "rotation: quaternion w, x, y, z, of any length but 0. offset: m. scale: scene metres per device\n"
              "metre. tip_offset: distance from the device's point to the tip along the stylus, m. Raises\n"
              "ConfigurationError.")
          .def_prop_ro(
              "rotation",
              [](const Placement& p) {
                return nb::make_tuple(p.rotation[0], p.rotation[1], p.rotation[2], p.rotation[3]);
              },
              nb::sig("def rotation(self) -> tuple[float, float, float, float]"))
          .def_prop_ro(
              "offset", [](const Placement& p) { return as_tuple(p.offset); },
              nb::sig("def offset(self) -> tuple[float, float, float]"), "m")
          .def_ro("scale", &Placement::scale)
          .def_ro("tip_offset", &Placement::tip_offset, "m");
  def_value(placement, {"rotation", "offset", "scale", "tip_offset"});

  auto info = nb::class_<DeviceInfo>(m, "DeviceInfo", "What a device says of itself; NaN where it does not say.");
  def_repr(info,
           "DeviceInfo(backend={0.backend!r}, model={0.model!r}, serial={0.serial!r}, "
           "has_orientation={0.has_orientation}, button_count={0.button_count}, max_force={0.max_force}, "
           "continuous_force={0.continuous_force}, max_stiffness={0.max_stiffness}, encoder_step={0.encoder_step}, "
           "rate={0.rate})");
  info.def(
          "__init__",
          [](DeviceInfo* self, const std::string& backend, const std::string& model, const std::string& serial,
             bool has_orientation, unsigned button_count, double max_force, double continuous_force,
             double max_stiffness, double encoder_step, double rate) {
            new (self) DeviceInfo{backend,      model,     serial,           has_orientation,
                                  button_count, max_force, continuous_force, max_stiffness,
                                  encoder_step, rate};
          },
          nb::kw_only(), nb::arg("backend") = "", nb::arg("model") = "", nb::arg("serial") = "",
          nb::arg("has_orientation") = false, nb::arg("button_count") = 0, nb::arg("max_force") = unknown,
          nb::arg("continuous_force") = unknown, nb::arg("max_stiffness") = unknown, nb::arg("encoder_step") = unknown,
          nb::arg("rate") = unknown,
          nb::sig("def __init__(self, *, backend: str = '', model: str = '', serial: str = '', "
                  "has_orientation: bool = False, button_count: int = 0, max_force: float = ..., "
                  "continuous_force: float = ..., max_stiffness: float = ..., encoder_step: float = ..., "
                  "rate: float = ...) -> None"),
          "Forces in N, max_stiffness in N/m, encoder_step in m, rate in Hz. An omitted value is unknown.")
      .def_ro("backend", &DeviceInfo::backend)
      .def_ro("model", &DeviceInfo::model)
      .def_ro("serial", &DeviceInfo::serial)
      .def_ro("has_orientation", &DeviceInfo::has_orientation)
      .def_ro("button_count", &DeviceInfo::button_count)
      .def_ro("max_force", &DeviceInfo::max_force, "Peak force, N")
      .def_ro("continuous_force", &DeviceInfo::continuous_force, "Continuous force, N")
      .def_ro("max_stiffness", &DeviceInfo::max_stiffness, "N/m")
      .def_ro("encoder_step", &DeviceInfo::encoder_step, "m")
      .def_ro("rate", &DeviceInfo::rate, "Servo rate, Hz");
}

}  // namespace punctura::bindings
