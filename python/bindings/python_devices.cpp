// runtime/backends: devices whose readings come from Python, all at once or one by one.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "punctura_runtime/backends/fed.hpp"
#include "punctura_runtime/backends/replay.hpp"
#include "punctura_runtime/loop/pacer.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
void check_rate(double rate) {
  std::vector<Problem> problems;
  check_field(field_of(servo_fields, &ServoSettings::rate), rate, "device", problems);
  raise_if(problems);
}

namespace {

/// An optional column. Throws TypeError and ValueError that name it.
template <typename T>
std::vector<T> column(const nb::object& given, const char* type, std::size_t n, const char* name) {
  if (given.is_none()) return {};
  const auto array = nb::cast<nb::ndarray<const T, nb::c_contig, nb::device::cpu>>(
      nb::module_::import_("numpy").attr("ascontiguousarray")(real_numbers(given, name, type)));
  if (array.ndim() != 1 || array.size() != n)
    throw value_error(std::string(name) + " must have shape (" + std::to_string(n) + ",)");
  return {array.data(), array.data() + n};
}

void make_replay(ReplayDevice* self, const ArrayLike& positions, const ArrayLike& axes, double rate,
                 const ArrayLike& times, const ArrayLike& sequences, const ArrayLike& held, const ArrayLike& health,
                 const ArrayLike& temperatures, DeviceInfo recorded, bool real_time, int priority, int processor) {
  check_rate(rate);
  const Input position = points(positions, "position");
  const std::size_t n = position.shape(0);
  const Rows axis(input(axes, "axis"), n, "axis");
  const auto time = column<double>(times, "float64", n, "time");
  const auto sequence = column<std::uint64_t>(sequences, "uint64", n, "sequence");
  const auto buttons = column<std::uint32_t>(held, "uint32", n, "buttons");
  const auto healthy = column<std::uint8_t>(health, "uint8", n, "healthy");
  const auto temperature = column<double>(temperatures, "float64", n, "motor_temperature");
  std::vector<DeviceSample> samples(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double* p = position.data() + 3 * k;
    samples[k].sequence = sequence.empty() ? k : sequence[k];
    samples[k].time = time.empty() ? static_cast<double>(k) / rate : time[k];
    samples[k].position = {p[0], p[1], p[2]};
    samples[k].axis = to_array(axis[k]);
    samples[k].buttons = buttons.empty() ? 0 : buttons[k];
    samples[k].healthy = healthy.empty() || healthy[k] != 0;
    samples[k].motor_temperature = temperature.empty() ? 0 : temperature[k];
  }
  recorded.rate = rate;
  new (self) ReplayDevice(std::move(samples), std::move(recorded),
                          {real_time, {.priority = priority, .processor = processor}});
}

void make_fed(FedDevice* self, double rate, DeviceInfo info, bool real_time) {
  check_rate(rate);
  info.rate = rate;
  new (self) FedDevice(std::move(info), real_time);
}

std::tuple<double, double, double> feed(FedDevice& device, const Triple& position, const Triple& axis,
                                        std::uint32_t buttons, bool healthy, double motor_temperature) {
  Triple force;
  {
    const WithoutLock release;  // a tick needs no GIL; other threads can run Python meanwhile
    force = device.feed({position, axis, buttons, healthy, motor_temperature});
  }
  return std::tuple_cat(force);
}

std::vector<std::string> make_realtime(int priority, int processor) {
  std::vector<std::string> lines;
  os::add_words(os::make_realtime({.priority = priority, .processor = processor}), lines);
  return lines;
}

void make_pacer(Pacer<>* self, double rate) {
  check_rate(rate);
  new (self) Pacer<>(rate);
}

}  // namespace

void bind_python_devices(nb::module_& m) {
  nb::class_<ReplayDevice, Device>(
      m, "ReplayDevice",
      "A device that plays a recorded motion: one tick per sample. It ignores the force and ends after the last\n"
      "sample.")
      .def("__init__", &make_replay, nb::arg("position"), nb::arg("axis"), nb::arg("rate"), nb::kw_only(),
           nb::arg("time") = nb::none(), nb::arg("sequence") = nb::none(), nb::arg("buttons") = nb::none(),
           nb::arg("healthy") = nb::none(), nb::arg("motor_temperature") = nb::none(),
           nb::arg("recorded") = DeviceInfo{}, nb::arg("real_time") = true,
           nb::arg("priority") = os::RealtimeSettings{}.priority,
           nb::arg("processor") = os::RealtimeSettings{}.processor,
           "position (n, 3): m. axis (n, 3) or (3,). rate: samples per second, Hz. time (n,): s, default k / rate;\n"
           "the input gate checks these times, not the timing of the replay. recorded: info of the recorded device,\n"
           "whose ratings limit the force. real_time: False runs as fast as possible. priority: real-time scheduling\n"
           "priority, 0 for none. processor: CPU number, -1 for any. Raises ConfigurationError for the rate,\n"
           "ValueError for a column's shape.")
      .def("__len__", &ReplayDevice::size, "Number of samples.")
      .def_prop_ro("finished", &ReplayDevice::finished, "Whether the last sample was played.")
      .def_prop_ro("behind", &ReplayDevice::behind, "Delay of the replay, in periods.");

  const FedDevice::Reading reading{};
  nb::class_<FedDevice, Device>(
      m, "FedDevice", nb::is_weak_referenceable(),
      "A device that a loop in Python drives: each reading that is fed is a tick, its force the reply.")
      .def(
          "__init__", &make_fed, nb::arg("rate"), nb::kw_only(), nb::arg("info") = DeviceInfo{},
          nb::arg("real_time") = true,
          "rate: Hz, at which readings will be fed; T is 1 / rate. info: what the device is; its force ratings tighten "
          "the\n"
          "limits. real_time: False takes the k-th reading as if it came at k / rate, for simulations that are not "
          "bound\n"
          "to the clock. Raises ConfigurationError.")
      .def(
          "feed", &feed, nb::arg("position"), nb::arg("axis") = reading.axis, nb::arg("buttons") = reading.buttons,
          nb::arg("healthy") = reading.healthy, nb::arg("motor_temperature") = reading.motor_temperature,
          "A reading in, the force for the device out, N; zero while no loop runs. position: m. axis: unit direction "
          "in\n"
          "which the needle points. buttons: bits. healthy: False is a fault of the device. motor_temperature: 0 to 1.")
      .def(
          "make_realtime",
          [](FedDevice& device, int priority, int processor) {
            const WithoutLock release;
            return device.make_realtime({.priority = priority, .processor = processor});
          },
          nb::arg("priority") = os::RealtimeSettings{}.priority,
          nb::arg("processor") = os::RealtimeSettings{}.processor,
          "Requests real-time scheduling for the calling thread. Call it on the feeding thread, before the first\n"
          "feed().\n\n"
          "priority: 1 to 99; 0 for none. processor: CPU number to stay on, -1 for any. Returns one line for each\n"
          "request: granted, or not and why. statements() repeats these lines.")
      .def_prop_ro("fed", &FedDevice::fed, "Number of readings since the loop's start.");

  m.def(
      "make_realtime", &make_realtime, nb::arg("priority") = os::RealtimeSettings{}.priority,
      nb::arg("processor") = os::RealtimeSettings{}.processor, nb::call_guard<WithoutLock>(),
      "Requests real-time scheduling for the calling thread. For the feeding thread use FedDevice.make_realtime().\n\n"
      "Threads that mostly wait can use a low priority, such as 10. Then a thread that holds the GIL does not wait\n"
      "for a CPU, and the feeding thread does not wait for the GIL. Returns one line for each request: granted, or\n"
      "not and why.");

  auto pacer = nb::class_<Pacer<>>(
      m, "Pacer",
      "Wakes one thread at a rate: at start, start + T, start + 2 T, ..., on a clock that never goes back.");
  def_repr(pacer, "<Pacer at {0.rate:g} Hz>");
  pacer.def_prop_ro("rate", &Pacer<>::rate, "Hz")
      .def("__init__", &make_pacer, nb::arg("rate"),
           "rate: Hz. The first period begins now. Raises ConfigurationError.")
      .def("wait", &Pacer<>::wait, nb::call_guard<WithoutLock>(),
           "Sleeps until the next period begins. Returns the number of skipped periods.\n\n"
           "A period is skipped if it has already passed. A late wake-up does not shift later ones, and skipped\n"
           "periods are not made up for.");
}

}  // namespace punctura::bindings
