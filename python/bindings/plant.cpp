// core/punctura/lab/plant: a simulated device in a simulated hand, the desired motion of the hand, and the experiment.

#include <nanobind/stl/optional.h>

#include "bindings.hpp"
#include "motion.hpp"
#include "punctura/lab/plant/check.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/lab/plant/stroke_ends.hpp"
#include "punctura/scene/check.hpp"
#include "state.hpp"
#include "struct.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

RecordedMotion recorded(const nb::object& times, const nb::object& positions) {
  const Input time = input_1d(times, "time"), position = points(positions, "position");
  const std::size_t n = time.size();
  if (n == 0) throw nb::value_error("time must hold at least one sample");
  if (position.shape(0) != n) throw nb::value_error("position must have one row for every time");
  std::vector<Vector3d> tips(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = position.data() + 3 * i;
    tips[i] = {row[0], row[1], row[2]};
    const std::string sample = "sample " + std::to_string(i);
    if (!std::isfinite(time.data()[i]) || (i > 0 && !(time.data()[i] > time.data()[i - 1])))
      throw value_error(sample + ": time must be finite and ascend");
    if (!std::all_of(row, row + 3, [](double x) { return is_place(x); }))
      throw value_error(sample + ": position must be three finite numbers, m, within 1000 km");
  }
  return {std::vector<double>(time.data(), time.data() + n), std::move(tips)};
}

}  // namespace

void bind_plant(nb::module_& m) {
  def_struct<plant_fields>(m,
                           {"Plant", "A simulated haptic device. Defaults: data sheet of the PHANTOM Omni.", "plant"});
  def_struct<hand_fields>(
      m, {"Hand",
          "A simulated hand that holds the stylus: a mass, with spring and damper to the desired motion. Values are\n"
          "illustrative.",
          "hand"});
  def_struct<strokes_rows>(
      m,
      {.name = "Strokes",
       .doc = "Repeated minimum-jerk strokes from start to end and back, with a rest at both ends.",
       .path = "strokes",
       .needed = 2},
      [](const Strokes& made, std::vector<Problem>& problems) { check(made, problems); })
      .def(
          "duration_for", [](const Strokes& s, std::uint64_t seed) { return StrokesMotion(s, seed).duration(); },
          nb::arg("seed") = 0, "Total duration of all strokes for a random seed, s.");

  const auto pair = [](const Vector3d& a, const Vector3d& b) {
    return std::make_tuple(std::tuple_cat(to_array(a)), std::tuple_cat(to_array(b)));
  };
  m.def(
      "stroke_ends",
      [pair](const Scene& scene) {
        raise_if(check(scene));
        const StrokeEnds ends = stroke_ends(scene);
        return pair(ends.start, ends.end);
      },
      nb::arg("scene"),
      "The two ends of the hand's strokes along the first membrane's normal, m: in front of all membranes, and behind\n"
      "the last.\n\n"
      "The far end adds the lag of the tip under the membranes' largest forces F: F / K of each in the coupling, and\n"
      "sum(F) / k in the hand's spring k. So the tip itself comes out behind. Raises ConfigurationError.");
  m.def(
      "resting_pose",
      [pair](const Scene& scene) {
        raise_if(check(scene));
        const HandPose pose = resting_pose(scene);
        return pair(pose.position, pose.axis);
      },
      nb::arg("scene"),
      "The first pose of a hand, position (m) and axis: in front of all membranes, pointing into the first.\n\n"
      "In a scene with blood, the needle is close to the skin, at 30 degrees to it, and points to the middle of the\n"
      "scene: the slanted tip of an upright needle is longer than a vein is wide. Raises ConfigurationError.");

  auto recorded_class =
      nb::class_<RecordedMotion>(m, "RecordedMotion", "A motion given by samples, with linear interpolation.");
  def_repr(recorded_class, "<RecordedMotion of {0.duration:g} s>");
  recorded_class
      .def(
          "__init__",
          [](RecordedMotion* self, const nb::object& time, const nb::object& position) {
            new (self) RecordedMotion(recorded(time, position));
          },
          nb::arg("time"), nb::arg("position"),
          nb::sig("def __init__(self, time: numpy.typing.ArrayLike, position: numpy.typing.ArrayLike) -> None"),
          "time (n,): s, ascending. position (n, 3): m. Raises ValueError, which names the sample.")
      .def(
          "__reduce__",
          [](nb::handle self) {
            const auto& motion = nb::cast<const RecordedMotion&>(self);
            const std::size_t n = motion.times().size();
            std::vector<double> rows;
            for (const Vector3d& p : motion.positions()) rows.insert(rows.end(), p.begin(), p.end());
            return nb::make_tuple(self.type(), nb::make_tuple(to_numpy(std::vector<double>(motion.times()), {n}),
                                                              to_numpy(std::move(rows), {n, 3})));
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"))
      .def_prop_ro("duration", &RecordedMotion::duration, "s");

  auto target =
      nb::class_<Target>(m, "Target", "A target position that move_to() changes in steps. The hand follows smoothly.");
  def_state(target, [](const Target& t) { return nb::make_tuple(to_array(t.position())); });
  def_repr(target, "<Target at {0.position} m>");
  target
      .def(
          "__init__", [](Target* self, const Triple& position) { new (self) Target(place(position)); },
          nb::arg("position"), "position: m. Raises ValueError.")
      .def_prop_ro(
          "position", [](const Target& t) { return to_array(t.position()); }, "Where it was moved last, m")
      .def(
          "move_to", [](Target& t, const Triple& position) { t.move_to(place(position)); }, nb::arg("position"),
          "position: m. Raises ValueError.");
}

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
