// core/punctura/plant/experiment.hpp: K06 section 4 without hardware.
#include "punctura/plant/experiment.hpp"

#include <nanobind/stl/variant.h>

#include "bindings.hpp"
#include "insertion_trace.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

struct ExperimentTrace : InsertionTrace {
  nb::object time, position, tip, desired, model_force;
  LimitCounters limits;
  Fault fault;
};

using AnyMotion = std::variant<Strokes, RecordedMotion, Target>;

/// One Python class for experiments with any motion.
class AnyExperiment {
 public:
  AnyExperiment(const Scene& scene, const AnyMotion& motion, const Vector3d& axis, const DeviceDynamics& plant,
                const Hand& hand, std::uint64_t seed)
      : rate_(scene.servo.rate) {
    if (const auto* strokes = std::get_if<Strokes>(&motion)) {
      StrokesMotion laid_out(*strokes, seed);
      duration_ = laid_out.duration();
      experiment_.emplace<Experiment<StrokesMotion>>(scene, std::move(laid_out), axis, plant, hand, seed);
    } else if (const auto* recorded = std::get_if<RecordedMotion>(&motion)) {
      duration_ = recorded->duration();
      experiment_.emplace<Experiment<RecordedMotion>>(scene, *recorded, axis, plant, hand, seed);
    } else {
      experiment_.emplace<Experiment<Target>>(scene, std::get<Target>(motion), axis, plant, hand, seed);
    }
  }

  double rate() const noexcept { return rate_; }
  double duration() const noexcept { return duration_; }

  void move_to(const Triple& position) {
    auto* with_target = std::get_if<Experiment<Target>>(&experiment_);
    if (!with_target) throw nb::type_error("move_to needs an experiment whose motion is a Target");
    with_target->motion().move_to(vector(position));
  }

  ExperimentTrace run(double duration) {
    if (!(duration >= 0 && std::isfinite(duration))) throw nb::value_error("duration must be 0 s or more");
    const auto n = static_cast<std::size_t>(std::llround(duration * rate_));
    return std::visit([&](auto& experiment) { return run(experiment, n); }, experiment_);
  }

 private:
  ExperimentTrace run(std::monostate&, std::size_t) { throw std::logic_error("no motion"); }

  template <typename E>
  ExperimentTrace run(E& experiment, std::size_t n) {
    const std::size_t m = experiment.servo().snapshot().membrane_count;
    MembraneColumns columns(n, m);
    std::vector<double> time(n), position(3 * n), tip(3 * n), desired(3 * n), force(3 * n), model_force(3 * n);
    const auto put = [](std::vector<double>& column, std::size_t i, const Triple& v) {
      std::copy(v.begin(), v.end(), &column[3 * i]);
    };
    make_ticks(n, [&](std::size_t i) {
      const Snapshot& s = experiment.step();
      time[i] = s.sample.time;
      put(position, i, s.sample.position);
      put(tip, i, plain(experiment.tip()));
      put(desired, i, plain(experiment.desired().position));
      put(force, i, s.force);
      put(model_force, i, s.model_force);
      for (std::size_t j = 0; j < m; ++j) {
        const MembraneRecord& r = s.membranes[j];
        columns.set(i, j, r.depth, r.axial_force, r.lower, r.upper, r.phase);
      }
    });
    const Snapshot& last = experiment.servo().snapshot();
    return {{to_numpy(std::move(force), {n, 3}), std::move(columns)},
            to_numpy(std::move(time), {n}),
            to_numpy(std::move(position), {n, 3}),
            to_numpy(std::move(tip), {n, 3}),
            to_numpy(std::move(desired), {n, 3}),
            to_numpy(std::move(model_force), {n, 3}),
            last.limits,
            last.fault};
  }

  double rate_, duration_ = 0;
  std::variant<std::monostate, Experiment<StrokesMotion>, Experiment<RecordedMotion>, Experiment<Target>> experiment_;
};

}  // namespace

void bind_experiment(nb::module_& m) {
  auto trace =
      nb::class_<ExperimentTrace>(m, "ExperimentTrace", "What an experiment gave, tick by tick; n ticks, m membranes.");
  const auto column = [&trace](const char* name, const char* signature, auto member, const char* doc) {
    trace.def_prop_ro(name, [member](const ExperimentTrace& t) { return t.*member; }, nb::sig(signature), doc);
  };
  column("time", "def time(self) -> numpy.typing.NDArray[numpy.float64]", &ExperimentTrace::time, "(n,), s");
  column("position", "def position(self) -> numpy.typing.NDArray[numpy.float64]", &ExperimentTrace::position,
         "What the encoders said, (n, 3), m");
  column("tip", "def tip(self) -> numpy.typing.NDArray[numpy.float64]", &ExperimentTrace::tip,
         "Where the tip was, (n, 3), m");
  column("desired", "def desired(self) -> numpy.typing.NDArray[numpy.float64]", &ExperimentTrace::desired,
         "What the hand wanted, (n, 3), m");
  column("force", "def force(self) -> numpy.typing.NDArray[numpy.float64]", &ExperimentTrace::force,
         "Sent to the device, after the limits, (n, 3), N");
  column("model_force", "def model_force(self) -> numpy.typing.NDArray[numpy.float64]", &ExperimentTrace::model_force,
         "Before the limits, (n, 3), N");
  def_membrane_columns(trace);
  trace.def_prop_ro(
      "limited_ticks", [](const ExperimentTrace& t) { return t.limits.peak + t.limits.continuous; },
      "Ticks in which a force limit acted, ramp-in apart, since the start");
  trace.def_prop_ro(
      "fault", [](const ExperimentTrace& t) -> std::string { return t.fault == Fault::none ? "" : describe(t.fault); },
      "What fault is latched, and what to do; empty for none");

  nb::class_<AnyExperiment>(
      m, "Experiment",
      "A simulated operator at a simulated device, through the step that drives a real one. K06 section 4")
      .def(
          "__init__",
          [](AnyExperiment* self, const Scene& scene, const AnyMotion& motion, const DeviceDynamics& plant,
             const Hand& hand, std::uint64_t seed, const nb::object& axis) {
            raise_if(check(scene));
            const Triple direction = axis.is_none() ? scene.membranes.front().inward_normal : nb::cast<Triple>(axis);
            new (self) AnyExperiment(scene, motion, unit(direction, "axis"), plant, hand, seed);
          },
          nb::arg("scene"), nb::arg("motion"), nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{},
          nb::arg("seed") = 0, nb::arg("axis") = nb::none(),
          nb::sig(
              "def __init__(self, scene: Scene, motion: Strokes | RecordedMotion | Target, plant: Plant = ..., hand: Hand = ..., "
              "seed: int = 0, axis: Sequence[float] | None = None) -> None"),
          "axis: where the stylus points; the first membrane's inward normal if not given. Raises ConfigurationError.")
      .def(
          "run", [](AnyExperiment& e, double duration) { return e.run(duration); }, nb::arg("duration"),
          "Goes on for a time (s). The arrays hold what came in that time.")
      .def_prop_ro("duration", &AnyExperiment::duration, "How long the motion takes, s; 0 for a Target")
      .def("move_to", &AnyExperiment::move_to, nb::arg("position"), "Moves the Target, m.");
}

}  // namespace punctura::bindings
