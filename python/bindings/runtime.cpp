// runtime: devices and the live loop. A tick never takes the GIL.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>

#include <limits>

#include "bindings.hpp"
#include "motion.hpp"
#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/motor_rest.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "state.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

/// The snapshots of a running loop, for one reader.
struct Listener : OneThread {
  explicit Listener(SnapshotRing* of) : ring(of) {}
  SnapshotRing* ring;

  TicksObject read(std::optional<std::size_t> limit) {
    TickColumns columns;
    const Running running(*this);
    {
      const WithoutLock release;
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

Object<"LoopReport"> report(const ServoLoop& loop) {
  const LoopReport r = loop.report();
  nb::dict d;
  d["ticks"] = r.ticks;
  d["late"] = r.late;
  d["period"] = quantiles(r.period, r.largest_period_ns);
  d["compute"] = quantiles(r.compute, r.largest_compute_ns);
  return d;
}

TicksObject as_ticks(const std::vector<Snapshot>& snapshots) {
  TickColumns columns;
  for (const Snapshot& s : snapshots) columns.add(s);
  return columns.to_ticks();
}

}  // namespace

void bind_runtime(nb::module_& m) {
  nb::exception<DeviceError>(m, "DeviceError", nb::make_tuple(m.attr("PuncturaError"), nb::borrow(PyExc_RuntimeError)));

  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const SceneError& error) {
      try {
        raise_if(error.problems());
      } catch (nb::python_error& raised) {
        raised.restore();
      }
    }
  });

  auto device = nb::class_<Device>(m, "Device", "An open haptic device. It makes the ticks on its own thread.");
  def_repr(device, "<{0.__class__.__name__} {0.info.model!r} at {0.info.rate:g} Hz>");
  device.def_prop_ro("info", &Device::info, nb::rv_policy::copy)
      .def_prop_rw(
          "spent", &kept_spent, [](Device& d, double spent) { keep_spent(d, spent, not_given); },
          "Motor load at the end of the last run that the motors have not recovered from, N^2 s.\n\n"
          "The next run starts with it, so that the limit on continuous force holds across runs. A value that is\n"
          "set counts in full: the time before the next run does not count as rest.")
      .def(
          "go_on_from", [](Device& d, const Device& previous) { go_on_from(previous, d); }, nb::arg("previous"),
          "Takes over the motor load of `previous`, an object for the same physical device.")
      .def_prop_ro(
          "longest_silence",
          [](const Device& d) { return std::pair(d.longest_silence().at_start, d.longest_silence().later); },
          "Longest time without a tick before a run is ended, s: before the first tick, and later.\n\n"
          "A longer deadline of the gate extends it to five deadlines. Infinite where nobody holds the device.")
      .def("trouble", &Device::trouble, nb::call_guard<WithoutLock>(),
           "Description of the problem; empty if there is none.")
      .def("statements", &Device::statements,
           "Notes for the user on how the device runs. Available after the loop's start.");

  const SimulatedOptions options;
  nb::class_<SimulatedDevice, Device>(m, "SimulatedDevice",
                                      "A simulated device in a simulated hand; by default a PHANTOM Omni.")
      .def(
          "__init__",
          [](SimulatedDevice* self, const AnyMotion& motion, const DeviceDynamics& plant, const Hand& hand, double rate,
             std::uint64_t seed, bool real_time, std::uint64_t ticks, const Triple& axis, int priority, int processor) {
            check_rate(rate);
            const os::RealtimeSettings realtime{.priority = priority, .processor = processor};
            new (self) SimulatedDevice(laid_out(motion, seed), {plant, hand, rate, seed, real_time, ticks,
                                                                to_array(unit(axis, "axis")), realtime});
          },
          nb::arg("motion"), nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{},
          nb::arg("rate") = options.rate, nb::arg("seed") = 0, nb::arg("real_time") = true, nb::arg("ticks") = 0,
          nb::arg("axis") = options.axis, nb::arg("priority") = options.realtime.priority,
          nb::arg("processor") = options.realtime.processor,
          "motion: Strokes, RecordedMotion or Target. rate: Hz. real_time: False runs as fast as possible. ticks:\n"
          "number of ticks, 0 for no end. axis: direction of the stylus. priority: real-time scheduling priority, 0\n"
          "for none. processor: CPU number, -1 for any. Raises ConfigurationError.")
      .def(
          "move_to",
          [](SimulatedDevice& d, const Triple& position) {
            place(position);
            d.move_to(position);
          },
          nb::arg("position"), "Moves the Target; the hand follows. position: m. Raises ValueError.")
      .def(
          "point",
          [](SimulatedDevice& d, const Triple& axis, std::uint32_t buttons) {
            d.point(to_array(unit(axis, "axis")), buttons);
          },
          nb::arg("axis"), nb::arg("buttons") = 0, "Sets the direction of the stylus and the held buttons (bits).")
      .def(
          "trip",
          [](SimulatedDevice& d) {
            d.spoil([](DeviceSample& s) { s.position.fill(std::numeric_limits<double>::quiet_NaN()); });
          },
          "Makes the position of the next reading NaN, which simulates an encoder failure.")
      .def_prop_ro("finished", &SimulatedDevice::finished, "Whether all requested ticks were made.")
      .def_prop_ro("missed", &SimulatedDevice::missed, "Number of ticks skipped because their time had passed.")
      .def_prop_ro("last_force", &SimulatedDevice::last_force, "The last force on the plant, N.");

  auto listener = nb::class_<Listener>(m, "Listener", "A ring with the snapshot of every tick, for one reader.");
  def_repr(listener, "<Listener with room for {0.capacity} ticks, {0.lost} lost>");
  listener
      .def("read", &Listener::read, nb::arg("limit") = nb::none(),
           "Removes and returns the oldest snapshots. limit: maximum number; None for all that are in the ring now.")
      // Not behind Getters: any thread may read them while another is in read().
      .def_prop_ro(
          "lost", [](const Listener& l) { return l.ring->lost(); },
          "Number of snapshots lost because the ring was full.")
      .def_prop_ro(
          "capacity", [](const Listener& l) { return l.ring->capacity(); },
          "Number of snapshots that fit in the ring, counted for the first scene.");

  auto loop = nb::class_<ServoLoop>(m, "ServoLoop",
                                    "Runs a scene on a device: one servo step per tick, on the device's thread.");
  def_repr(loop, "<ServoLoop of {0.scene.name!r} on {0.device}: running={0.running}, {0.ticks} ticks>");
  loop.def(
          "__init__",
          [](ServoLoop* self, std::shared_ptr<Device> device, const Scene& scene, const GateLimits& gate,
             const ForceLimits& limits, const Placement& placement, std::shared_ptr<ThumbLoop> thumb,
             const std::vector<AnyRival>& rivals) {
            LoopSettings settings{gate, limits, placement};
            settings.thumb = std::move(thumb);
            settings.model = StepMaker::with_rivals(rivals);
            new (self) ServoLoop(std::move(device), scene, settings);
          },
          nb::arg("device"), nb::arg("scene"), nb::arg("gate") = GateLimits{}, nb::arg("limits") = ForceLimits{},
          nb::arg("placement") = Placement{}, nb::arg("thumb") = nb::none(), nb::kw_only(),
          nb::arg("rivals") = std::vector<AnyRival>(),
          "A device can be in one running loop at a time. The period is the device's own. Its force ratings tighten\n"
          "the limits. thumb: a second device, which holds the plunger of the scene's syringe. rivals: force models\n"
          "of other authors in place of the scene's law, one, or one for each membrane. Raises ConfigurationError.")
      .def(
          "start",
          [](ServoLoop& loop, std::optional<double> duration) {
            const WithoutLock release;
            loop.start(duration.value_or(ServoLoop::endless));
          },
          nb::arg("duration") = nb::none(),
          "Starts the ticks, disarmed. Raises DeviceError.\n\n"
          "duration: s. After it the ticks give no force and are not recorded, and a thread of the loop stops the\n"
          "device. The same thread stops a device whose ticks cease: see silence. It needs no GIL.")
      .def("stop", &ServoLoop::stop, nb::call_guard<WithoutLock>(), "Sets zero force, then ends the ticks.")
      .def(
          "__enter__", [](ServoLoop& loop) -> ServoLoop& { return loop; }, nb::rv_policy::reference)
      .def(
          "__exit__",
          [](ServoLoop& loop, const nb::args&) {
            const WithoutLock release;
            loop.stop();
          },
          nb::sig("def __exit__(self, *how: object) -> None"), "Calls stop(), also after an exception.")
      .def("arm", &ServoLoop::arm, "Enables force as soon as the tip is outside tissue.")
      .def("pause", &ServoLoop::pause, "Disables force. Ticks continue.")
      .def("reset", &ServoLoop::reset, "Clears a latched fault. The loop is then disarmed.")
      .def(
          "push_plunger",
          [](ServoLoop& loop, double force) {
            if (!(force >= 0 && force <= strongest_thumb)) throw nb::value_error("force must be from 0 to 15 N");
            loop.push_plunger(force);
          },
          nb::arg("force"),
          "A simulated thumb pushes the plunger of the scene's syringe with this force, N; 0 to 15.\n\n"
          "With a thumb device, or without a syringe in the scene, it has no effect. Raises ValueError.")
      .def(
          "exchange",
          [](ServoLoop& loop, const Scene& scene) {
            const WithoutLock release;
            loop.exchange(scene);
          },
          nb::arg("scene"),
          "Replaces the scene between two ticks; the change of the force is faded in over 0.2 s. On\n"
          "ConfigurationError nothing changes.")
      .def(
          "listen",
          [](ServoLoop& loop, std::optional<std::size_t> capacity) {
            return Listener(&loop.listen(capacity.value_or(loop.room())));
          },
          nb::arg("capacity") = nb::none(), nb::keep_alive<0, 1>(),
          "Returns a Listener for the snapshots of all ticks. Call it before start().\n\n"
          "capacity: number of snapshots of the present scene that the ring can hold; default `room`. It is reduced\n"
          "to 32 MB without an error; the listener's `capacity` has the actual number. Snapshots that do not fit\n"
          "are lost and counted in the listener's `lost`.")
      .def_prop_ro("running", &ServoLoop::running)
      .def_prop_ro("over", &ServoLoop::over,
                   "Whether the last run has ended by itself. Its device may still be stopping.")
      .def_prop_ro("silence", &ServoLoop::silence,
                   "Why ticks that ceased have ended the last run, in words; otherwise empty.")
      .def_prop_ro("device", &ServoLoop::device, nb::rv_policy::reference_internal)
      .def_prop_ro("scene", &ServoLoop::copy_scene, "The running scene, at the device's rate.")
      .def_prop_ro("gate", &ServoLoop::gate, nb::rv_policy::copy)
      .def_prop_ro("spent", &ServoLoop::spent, "Motor load of the device at the next start, N^2 s.")
      .def_prop_ro("limits", &ServoLoop::limits, nb::rv_policy::copy,
                   "The force limits in effect, device ratings included.")
      .def_prop_ro("force_scale", &ServoLoop::force_scale,
                   "How much of the model's force the device gives in the running scene, before the limits.")
      .def("report", &report,
           "Timing statistics of all runs so far: ticks, late, and for period and compute the quantiles p50, p99,\n"
           "p99_9, the largest (s) and the counts by bin.")
      .def(
          "latest", [](ServoLoop& loop) { return as_ticks({loop.latest()}); },
          "The last tick, one row; all zeros before the first tick.")
      .def(
          "fault_history", [](ServoLoop& loop) { return as_ticks(loop.fault_history()); },
          "The last ticks up to the latched fault; empty if there is none.");

  const Getters get{loop};
  get("room", "Default capacity of a listener for the present scene: 8 s of snapshots, at most 32 MB.",
      [](auto& l) { return l.room(); });
  get("ticks", "Number of ticks so far, in all runs", [](auto& l) { return l.report().ticks; });
  get("rivals", "The force models in place of the scene's law; empty if there are none.",
      [](auto& l) { return l.model().rivals(); });

  // Without this, a loop still held by a daemon thread or an interactive session would leave the last force on its
  // device.
  nb::module_::import_("atexit").attr("register")(nb::cpp_function([] {
    {
      const WithoutLock release;
      ServoLoop::stop_all();
    }
    EndOfProgram::begin();
  }));
  const nb::module_ os = nb::module_::import_("os");
  if (nb::hasattr(os, "register_at_fork"))  // not on Windows
    os.attr("register_at_fork")(nb::arg("after_in_child") = nb::cpp_function([] { EndOfProgram::begin_child(); }));
}

}  // namespace punctura::bindings
