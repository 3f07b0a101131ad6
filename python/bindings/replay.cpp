// Replay: the inputs of a recording through the servo step again.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "punctura/scene/build.hpp"
#include "snapshot_columns.hpp"

namespace punctura::bindings {
namespace {

template <typename T, typename... Shape>
using Column = nb::ndarray<const T, nb::c_contig, nb::device::cpu, Shape...>;
template <typename T>
using Scalars = Column<T, nb::ndim<1>>;
using Triples = Column<double, nb::shape<-1, 3>>;

std::string compiler() {
#if defined(__clang__)
  std::string name = "Clang " __clang_version__;
#elif defined(__GNUC__)
  std::string name = "GCC " __VERSION__;
#elif defined(_MSC_VER)
  std::string name = "MSVC " + std::to_string(_MSC_FULL_VER);
#else
  std::string name = "unknown compiler";
#endif
#ifdef __FMA__
  name += " fma";
#endif
  return name;
}

/// A servo step that is given what another one was given, in the order in which the loop gives it.
class Replay {
 public:
  Replay(const Scene& scene, const GateLimits& gate, const ForceLimits& limits, double spent)
      : rate_(scene.servo.rate), gate_(gate), limits_(limits), step_(built(scene)) {
    step_->set_spent(spent);
  }

  nb::dict run(const Scalars<std::uint64_t>& sequence, const Scalars<double>& time, const Triples& position,
               const Triples& axis, const Scalars<std::uint32_t>& buttons, const Scalars<std::uint8_t>& healthy,
               const Scalars<double>& motor_temperature, const Scalars<std::uint32_t>& commands,
               const std::vector<std::vector<Scene>>& scenes) {
    const std::size_t n = time.size();
    if (sequence.size() != n || position.shape(0) != n || axis.shape(0) != n || buttons.size() != n ||
        healthy.size() != n || motor_temperature.size() != n || commands.size() != n)
      throw std::invalid_argument("the columns must be of one length");
    const auto asked = std::count_if(commands.data(), commands.data() + n,
                                     [](std::uint32_t bits) { return (bits & command_scene) != 0; });
    if (static_cast<std::size_t>(asked) != scenes.size())
      throw std::invalid_argument("there must be scenes for every tick that took one");

    SnapshotColumns columns;
    {
      nb::gil_scoped_release release;
      columns.reserve(n);
      auto taken = scenes.begin();
      for (std::size_t k = 0; k < n; ++k) {
        const std::uint32_t bits = commands.data()[k];
        if (bits & command_scene)
          for (const Scene& scene : *taken++) take(scene);
        if (bits & command_reset) step_->reset();
        if (bits & command_arm) step_->arm();
        if (bits & command_disarm) step_->disarm();
        const double *p = position.data() + 3 * k, *a = axis.data() + 3 * k;
        DeviceSample sample{};
        sample.sequence = sequence.data()[k];
        sample.time = time.data()[k];
        sample.position = {p[0], p[1], p[2]};
        sample.axis = {a[0], a[1], a[2]};
        sample.buttons = buttons.data()[k];
        sample.healthy = healthy.data()[k] != 0;
        sample.motor_temperature = motor_temperature.data()[k];
        columns.add(step_->step(sample));
      }
    }
    return columns.to_dict();
  }

 private:
  std::unique_ptr<ServoStep> built(Scene scene) const {
    scene.servo.rate = rate_;  // the device's, as in the loop
    return std::make_unique<ServoStep>(build(scene, gate_, limits_));
  }
  void take(const Scene& scene) {
    auto next = built(scene);
    next->resume(*step_);
    step_ = std::move(next);
  }

  double rate_;
  GateLimits gate_;
  ForceLimits limits_;
  std::unique_ptr<ServoStep> step_;
};

}  // namespace

void bind_replay(nb::module_& m) {
  m.def("compiler", &compiler, "What the core was compiled with.");

  nb::class_<Replay>(m, "Replay", "The servo step of a loop, given again what it was given.")
      .def(
          "__init__",
          [](Replay* self, const Scene& scene, const GateLimits& gate, const ForceLimits& limits, double spent) {
            raise_if(check(scene));
            new (self) Replay(scene, gate, limits, spent);
          },
          nb::arg("scene"), nb::arg("gate"), nb::arg("limits"), nb::arg("spent") = 0.0,
          "scene: at the device's rate. spent: what the motors had given before, N^2 s. Starts as a loop does before its\n"
          "first tick.")
      .def(
          "run", &Replay::run, nb::arg("sequence"), nb::arg("time"), nb::arg("position"), nb::arg("axis"),
          nb::arg("buttons"), nb::arg("healthy"), nb::arg("motor_temperature"), nb::arg("commands"), nb::arg("scenes"),
          nb::sig("def run(self, sequence: typing.Any, time: typing.Any, position: typing.Any, axis: typing.Any, "
                  "buttons: typing.Any, healthy: typing.Any, motor_temperature: typing.Any, commands: typing.Any, "
                  "scenes: Sequence[Sequence[Scene]]) -> dict[str, typing.Any]"),
          "The next ticks, as columns like a Listener's. scenes: for every tick whose commands say that it took one, those\n"
          "taken, in their order.");
}

}  // namespace punctura::bindings
