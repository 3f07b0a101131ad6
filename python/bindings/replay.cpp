// Replays a recording: runs its inputs through the servo step again.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "input_columns.hpp"
#include "punctura_runtime/loop/step_maker.hpp"
#include "state.hpp"
#include "tick_columns.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

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

/// A servo step that gets the recorded inputs in the order of the original loop.
class Replay : public OneThread {
 public:
  Replay(const Scene& scene, const GateLimits& gate, const ForceLimits& limits, double spent, StepMaker model)
      : rate_(scene.servo.rate), gate_(gate), limits_(limits), model_(std::move(model)), step_(built(scene)) {
    step_->guard().set_spent(spent);
  }

  TicksObject run(const Object<"typing.Any">& ticks, const std::vector<std::vector<Scene>>& scenes) {
    const InputColumns given(ticks);
    Snapshot now{};
    std::size_t asked = 0;
    for (std::size_t k = 0; k < given.rows(); ++k) {
      given.read(k, now);
      asked += (now.commands & command_scene) != 0;
    }
    if (asked != scenes.size()) throw std::invalid_argument("there must be scenes for every tick that took one");

    TickColumns columns;
    columns.reserve(given.rows(), step_->guard().snapshot().membrane_count);
    auto taken = scenes.begin();
    const Running running(*this);
    make_ticks(given.rows(), [&](std::size_t k) {
      given.read(k, now);
      if (now.commands & command_scene)
        for (const Scene& scene : *taken++) take(scene);
      if (now.commands & command_reset) step_->reset();
      if (now.commands & command_arm) step_->guard().arm();
      if (now.commands & command_disarm) step_->guard().disarm();
      columns.add(step_->step(now.sample));
    });
    return columns.to_ticks();
  }

  double rate() const noexcept { return rate_; }

 private:
  std::unique_ptr<AnyStep> built(Scene scene) const {
    scene.servo.rate = rate_;  // the device's rate, as in the loop
    return model_(scene, gate_, limits_);
  }
  void take(const Scene& scene) {
    auto next = built(scene);
    next->resume(*step_);
    step_ = std::move(next);
  }

  double rate_;
  GateLimits gate_;
  ForceLimits limits_;
  StepMaker model_;
  std::unique_ptr<AnyStep> step_;
};

}  // namespace

void bind_replay(nb::module_& m) {
  m.def("compiler", &compiler, "Name and version of the compiler of the core.");

  auto replay = nb::class_<Replay>(m, "Replay", "Runs recorded inputs through the servo step of a loop again.");
  def_repr(replay, "<Replay at {0.rate:g} Hz>");
  replay
      .def(
          "__init__",
          [](Replay* self, const Scene& scene, const GateLimits& gate, const ForceLimits& limits, double spent,
             const std::vector<AnyRival>& rivals) {
            new (self) Replay(scene, gate, limits, spent, StepMaker::with_rivals(rivals));
          },
          nb::arg("scene"), nb::arg("gate"), nb::arg("limits"), nb::arg("spent") = 0.0, nb::kw_only(),
          nb::arg("rivals") = std::vector<AnyRival>(),
          "Starts in the state of a loop before its first tick. scene: at the device's rate. spent: motor load\n"
          "before the run, N^2 s. rivals: of the loop.")
      .def_prop_ro("rate", &Replay::rate, "Hz")
      .def("run", &Replay::run, nb::arg("ticks"), nb::arg("scenes"),
           "Computes ticks from inputs. ticks: Ticks or a mapping with all input fields. scenes: a list of the taken\n"
           "scenes, in order, for each tick whose commands say that it took a scene.");
}

}  // namespace punctura::bindings
