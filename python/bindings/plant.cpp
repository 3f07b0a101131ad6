// core/punctura/lab/plant: a simulated device in a simulated hand, and the desired motion of the hand.
#include "punctura/lab/plant/plant.hpp"

#include "bindings.hpp"
#include "punctura/lab/plant/check.hpp"
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
      throw nb::value_error((sample + ": time must be finite and ascend").c_str());
    if (!std::all_of(row, row + 3, [](double x) { return is_place(x); }))
      throw nb::value_error((sample + ": position must be three finite numbers, m, within 1000 km").c_str());
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

}  // namespace punctura::bindings
