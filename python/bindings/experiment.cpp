// core/punctura/lab/plant/experiment.hpp: K06 section 4 without hardware.
#include "punctura/lab/plant/experiment.hpp"

#include <nanobind/stl/optional.h>

#include "bindings.hpp"
#include "motion.hpp"
#include "state.hpp"

namespace punctura::bindings {
namespace {

/// One Python class for all kinds of motion. It keeps its constructor arguments.
class AnyExperiment : public OneThread {
 public:
  AnyExperiment(const Scene& scene, const AnyMotion& motion, const Vector3d& axis, const DeviceDynamics& plant,
                const Hand& hand, std::uint64_t seed)
      : scene_(scene),
        motion_(motion),
        axis_(to_array(axis)),
        plant_(plant),
        hand_(hand),
        seed_(seed),
        experiment_(std::visit(
            [&]<typename Motion>(Motion laid_out) -> AnyOne {
              if constexpr (!std::is_same_v<Motion, Target>) duration_ = laid_out.duration();
              return Experiment<Motion>(scene, std::move(laid_out), axis, plant, hand, seed);
            },
            laid_out(motion, seed))) {}

  const Scene& scene() const noexcept { return scene_; }
  double duration() const noexcept { return duration_; }

  void move_to(const Triple& position) {
    must_rest();
    auto* with_target = std::get_if<Experiment<Target>>(&experiment_);
    if (!with_target) throw nb::type_error("move_to needs an experiment whose motion is a Target");
    with_target->motion().move_to(place(position));
  }

  std::uint64_t ticks() const {
    return std::visit([](const auto& experiment) { return experiment.ticks(); }, experiment_);
  }

  TicksObject run(double duration, const ProgressArgument& progress) {
    const std::size_t n = ticks_in(duration, scene_.servo.rate);
    const Running running(*this);
    return std::visit([&](auto& experiment) { return run_experiment(experiment, n, progress); }, experiment_);
  }

  std::vector<std::byte> save() const {
    return std::visit([](const auto& experiment) { return save_state(experiment); }, experiment_);
  }
  bool load(std::span<const std::byte> state) {
    return std::visit([&](auto& experiment) { return load_state(experiment, state); }, experiment_);
  }
  nb::tuple arguments() const { return nb::make_tuple(scene_, motion_, plant_, hand_, seed_, axis_); }

 private:
  using AnyOne = std::variant<Experiment<StrokesMotion>, Experiment<RecordedMotion>, Experiment<Target>>;

  Scene scene_;
  AnyMotion motion_;
  Triple axis_;
  DeviceDynamics plant_;
  Hand hand_;
  std::uint64_t seed_;
  double duration_ = 0;
  AnyOne experiment_;
};

}  // namespace

void bind_experiment(nb::module_& m) {
  auto experiment = nb::class_<AnyExperiment>(
      m, "Experiment", nb::is_final(),
      "A simulated operator at a simulated device, run through the servo step that drives a real device. "
      "K06 section 4");
  def_state(experiment);
  def_repr(experiment, "<Experiment in {0.scene.name!r}: {0.ticks} ticks>");
  experiment
      .def(
          "__init__",
          [](AnyExperiment* self, const Scene& scene, const AnyMotion& motion, const DeviceDynamics& plant,
             const Hand& hand, std::uint64_t seed, const std::optional<Triple>& axis) {
            raise_if(check(scene));
            const Triple direction = axis.value_or(scene.membranes.front().inward_normal);
            new (self) AnyExperiment(scene, motion, unit(direction, "axis"), plant, hand, seed);
          },
          nb::arg("scene"), nb::arg("motion"), nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{},
          nb::arg("seed") = 0, nb::arg("axis") = nb::none(),
          "axis: direction of the stylus; default: the first membrane's inward normal. Raises ConfigurationError.")
      .def("run", &AnyExperiment::run, nb::arg("duration"), nb::kw_only(), nb::arg("progress") = nb::none(),
           "Runs the experiment for `duration` seconds more. Returns its ticks, with desired and true_position.\n\n"
           "progress: a function of the finished share, 0 to 1, or True for a bar. After Ctrl-C some\n"
           "ticks were made and are lost; `state` goes back to an earlier tick.")
      .def_prop_ro("scene", &AnyExperiment::scene)
      .def_prop_ro("duration", &AnyExperiment::duration, "Duration of the motion, s; 0 for a Target")
      .def("move_to", &AnyExperiment::move_to, nb::arg("position"), "Moves the Target, m. Raises ValueError.");
  const Getters get{experiment};
  get("ticks", "Number of ticks so far", &AnyExperiment::ticks);
}

}  // namespace punctura::bindings
