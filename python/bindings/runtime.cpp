// runtime: devices and the live loop. No tick ever takes the GIL.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/variant.h>

#include <limits>

#include "bindings.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "tick_columns.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

using AnyMotion = std::variant<Strokes, RecordedMotion, Target>;

SimulatedDevice::Motion laid_out(const AnyMotion& motion, std::uint64_t seed) {
  if (const auto* strokes = std::get_if<Strokes>(&motion)) return StrokesMotion(*strokes, seed);
  if (const auto* recorded = std::get_if<RecordedMotion>(&motion)) return *recorded;
  return std::get<Target>(motion);
}

/// Snapshots of a running loop, for one reader.
struct Listener {
  SnapshotRing* ring;

  nb::object read(std::optional<std::size_t> limit) {
    SnapshotColumns columns;
    {
      nb::gil_scoped_release release;
      const std::size_t most = limit.value_or(std::numeric_limits<std::size_t>::max());
      columns.reserve(std::min<std::size_t>(most, 4096));
      ring->pop(most, [&](const Snapshot& s) { columns.add(s); });
    }
    return columns.to_ticks();
  }
};

nb::dict quantiles(const Histogram::Counts& counts, std::uint64_t largest) {
  nb::dict d;
  const auto seconds = [](std::uint64_t ns) { return static_cast<double>(ns) * 1e-9; };
  d["p50"] = seconds(Histogram::quantile(counts, 0.5));
  d["p99"] = seconds(Histogram::quantile(counts, 0.99));
  d["p99_9"] = seconds(Histogram::quantile(counts, 0.999));
  d["largest"] = seconds(largest);
  std::vector<std::uint64_t> copy(counts.begin(), counts.end());
  d["counts"] = to_numpy(std::move(copy), {counts.size()});
  return d;
}

nb::dict report(const ServoLoop& loop) {
  const LoopReport r = loop.report();
  nb::dict d;
  d["ticks"] = r.ticks;
  d["late"] = r.late;
  d["period"] = quantiles(r.period, r.largest_period_ns);
  d["compute"] = quantiles(r.compute, r.largest_compute_ns);
  return d;
}

nb::object as_ticks(const std::vector<Snapshot>& snapshots) {
  SnapshotColumns columns;
  for (const Snapshot& s : snapshots) columns.add(s);
  return columns.to_ticks();
}

}  // namespace

void bind_runtime(nb::module_& m) {
  nb::exception<DeviceError>(m, "DeviceError", nb::make_tuple(m.attr("PuncturaError"), nb::borrow(PyExc_RuntimeError)));

  nb::class_<Device>(m, "Device", "An open haptic device. It calls the tick from a thread of its own.")
      .def_prop_ro("info", &Device::info, nb::rv_policy::copy)
      .def_prop_rw(
          "spent", [](const Device& d) { return d.motor_use.spent; },
          [](Device& d, double spent) { d.motor_use = {spent, unknown}; },
          "What its motors had given at the end of the last run and not recovered from, N^2 s. The next run goes on with\n"
          "it: the limit on continuous force holds across runs. What is set counts in full; no time counts as rest.")
      .def(
          "go_on_from", [](Device& d, const Device& previous) { d.motor_use = previous.motor_use; },
          nb::arg("previous"),
          "This object stands for the same motors as another one: its next run goes on with what they have given.")
      .def("trouble", &Device::trouble, nb::call_guard<nb::gil_scoped_release>(),
           "What went wrong, in words; empty if nothing did.")
      .def("statements", &Device::statements, "What its user should know of how it runs. After the loop's start.");

  const SimulatedOptions options;
  nb::class_<SimulatedDevice, Device>(m, "SimulatedDevice",
                                      "The plant as a device: a PHANTOM Omni in a simulated hand.")
      .def(
          "__init__",
          [](SimulatedDevice* self, const AnyMotion& motion, const DeviceDynamics& plant, const Hand& hand, double rate,
             std::uint64_t seed, bool real_time, std::uint64_t ticks, const Triple& axis, int priority, int processor) {
            SimulatedOptions made;
            made.dynamics = plant;
            made.hand = hand;
            std::vector<Problem> problems;
            check_field(servo_fields[0], rate, "device", problems);
            raise_if(problems);
            made.rate = rate;
            made.seed = seed;
            made.real_time = real_time;
            made.ticks = ticks;
            made.axis = to_array(unit(axis, "axis"));
            made.realtime.priority = priority;
            made.realtime.processor = processor;
            new (self) SimulatedDevice(laid_out(motion, seed), made);
          },
          nb::arg("motion"), nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{},
          nb::arg("rate") = options.rate, nb::arg("seed") = 0, nb::arg("real_time") = true, nb::arg("ticks") = 0,
          nb::arg("axis") = options.axis, nb::arg("priority") = options.realtime.priority,
          nb::arg("processor") = options.realtime.processor,
          "motion: Strokes, RecordedMotion or Target. rate: Hz. real_time: False runs as fast as possible. ticks: how many; 0 is no\n"
          "end. axis: where the stylus points. priority: of real-time scheduling, 0 asks for none. processor: the one to tick on,\n"
          "-1 is any.")
      .def("move_to", &SimulatedDevice::move_to, nb::arg("position"), "Of a Target: where the hand shall go, m.")
      .def(
          "point",
          [](SimulatedDevice& d, const Triple& axis, std::uint32_t buttons) {
            d.point(to_array(unit(axis, "axis")), buttons);
          },
          nb::arg("axis"), nb::arg("buttons") = 0, "Where the stylus points, and the buttons that are held (bits).")
      .def(
          "trip",
          [](SimulatedDevice& d) {
            d.spoil([](DeviceSample& s) { s.position.fill(std::numeric_limits<double>::quiet_NaN()); });
          },
          "The next reading's position is no number: what an encoder that fails looks like to the loop.")
      .def_prop_ro("finished", &SimulatedDevice::finished, "All ticks asked for have been.")
      .def_prop_ro("missed", &SimulatedDevice::missed, "Ticks left out since their time had passed.")
      .def_prop_ro("last_force", &SimulatedDevice::last_force, "What the plant was given last, N.");

  nb::class_<Listener>(m, "Listener", "Every tick's snapshot, for one reader.")
      .def("read", &Listener::read, nb::arg("limit") = nb::none(),
           nb::sig("def read(self, limit: int | None = None) -> Ticks"),
           "Takes the oldest snapshots, `limit` at most; without it all that are there when it is called.")
      .def_prop_ro(
          "lost", [](const Listener& l) { return l.ring->lost(); }, "Snapshots that found no room.")
      .def_prop_ro(
          "capacity", [](const Listener& l) { return l.ring->capacity(); },
          "Snapshots of the first scene that it holds.");

  nb::class_<ServoLoop>(m, "ServoLoop", "A scene on a device: the servo step, tick after tick, on the device's thread.")
      .def(
          "__init__",
          [](ServoLoop* self, std::shared_ptr<Device> device, const Scene& scene, const GateLimits& gate,
             const ForceLimits& limits, const Placement& placement) {
            LoopSettings settings;
            settings.gate = gate;
            settings.limits = limits;
            settings.placement = placement;
            new (self) ServoLoop(std::move(device), scene, settings);
          },
          nb::arg("device"), nb::arg("scene"), nb::arg("gate") = GateLimits{}, nb::arg("limits") = ForceLimits{},
          nb::arg("placement") = Placement{},
          "A device runs in one loop at a time. The period is the device's own; its force ratings\n"
          "tighten the limits.")
      .def("start", &ServoLoop::start, nb::call_guard<nb::gil_scoped_release>(),
           "Ticks come, disarmed. Raises DeviceError.")
      .def("stop", &ServoLoop::stop, nb::call_guard<nb::gil_scoped_release>(), "Zero force, then no tick any more.")
      .def(
          "__enter__", [](ServoLoop& loop) -> ServoLoop& { return loop; }, nb::rv_policy::reference)
      .def(
          "__exit__",
          [](ServoLoop& loop, const nb::args&) {
            nb::gil_scoped_release release;
            loop.stop();
          },
          nb::sig("def __exit__(self, *how: object) -> None"),
          "Zero force, then no tick any more, however the block has ended.")
      .def("arm", &ServoLoop::arm, "Force, once the tip is outside tissue.")
      .def("pause", &ServoLoop::pause, "No force; ticks go on.")
      .def("reset", &ServoLoop::reset, "Leaves a fault; disarmed.")
      .def(
          "exchange",
          [](ServoLoop& loop, const Scene& scene) {
            raise_if(check(scene));
            nb::gil_scoped_release release;
            loop.exchange(scene);
          },
          nb::arg("scene"),
          "Another scene, taken between two ticks and faded in. Raises ConfigurationError; then nothing has changed.")
      .def(
          "listen",
          [](ServoLoop& loop, std::optional<std::size_t> capacity) {
            return Listener{&loop.listen(capacity.value_or(loop.room()))};
          },
          nb::arg("capacity") = nb::none(), nb::keep_alive<0, 1>(),
          nb::sig("def listen(self, capacity: int | None = None) -> Listener"),
          "Before start: every tick's snapshot from then on. capacity: how many of the present scene wait for a late reader;\n"
          "without it `room`. A larger one than 32 MB hold is cut to that, without an error: the listener's `capacity` says\n"
          "how many there are room for. Snapshots that find no room are lost, and counted in its `lost`.")
      .def_prop_ro(
          "room", [](const ServoLoop& loop) { return loop.room(); },
          "Snapshots of the present scene that a listener holds: 8 s of them, or as many as 32 MB hold.")
      .def_prop_ro("running", &ServoLoop::running)
      .def_prop_ro("device", &ServoLoop::device, nb::rv_policy::reference_internal)
      .def_prop_ro("scene", &ServoLoop::scene, nb::rv_policy::copy, "As it runs, at the device's rate.")
      .def_prop_ro("gate", &ServoLoop::gate, nb::rv_policy::copy)
      .def_prop_ro("spent", &ServoLoop::spent, "What the device's motors have given before the next start, N^2 s.")
      .def_prop_ro("limits", &ServoLoop::limits, nb::rv_policy::copy, "As they act, with the device's ratings.")
      .def(
          "report", &report, nb::sig("def report(self) -> dict[str, typing.Any]"),
          "ticks, late, and of period and compute the quantiles p50, p99, p99_9, the largest (s) and the counts by bin.")
      .def(
          "latest", [](ServoLoop& loop) { return as_ticks({loop.latest()}); }, nb::sig("def latest(self) -> Ticks"),
          "The last tick, one row; all zeros before the first tick.")
      .def(
          "fault_history", [](ServoLoop& loop) { return as_ticks(loop.fault_history()); },
          nb::sig("def fault_history(self) -> Ticks"), "The last ticks up to the latched fault; none without one.");

  // A loop that a daemon thread or an interactive session still holds would leave its device with the last force.
  nb::module_::import_("atexit").attr("register")(nb::cpp_function([] {
    {
      nb::gil_scoped_release release;
      ServoLoop::stop_all();
    }
    WithoutLock::end_program();
  }));
}

}  // namespace punctura::bindings
