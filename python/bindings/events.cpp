// core/punctura/lab/events: events at the membranes, and the characteristic depths and curves of their laws.
#include "punctura/lab/events/event_finder.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "punctura/lab/events/law_curve.hpp"
#include "state.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A column of a batch with `width` doubles per row. NaN if the batch does not have the column.
class Column {
 public:
  /// width: doubles per row. Throws ValueError for another shape.
  Column(const nb::object& columns, const char* name, std::size_t rows, std::size_t width) : width_(width) {
    if (!nb::cast<bool>(columns.attr("__contains__")(name))) return;
    array_ = input(columns[name], name);
    if (array_->ndim() == 0 || array_->shape(0) != rows || array_->size() != rows * width)
      throw value_error("columns[\"" + std::string(name) + "\"] must have " + std::to_string(rows) + " rows of " +
                        std::to_string(width) + " numbers, as columns[\"depth\"] has");
  }
  explicit operator bool() const noexcept { return array_.has_value(); }
  double operator()(std::size_t row, std::size_t i = 0) const noexcept {
    return array_ ? array_->data()[row * width_ + i] : nan;
  }
  Triple triple(std::size_t row, std::size_t i = 0) const noexcept {
    return {(*this)(row, 3 * i), (*this)(row, 3 * i + 1), (*this)(row, 3 * i + 2)};
  }

 private:
  std::optional<Input> array_;
  std::size_t width_;
};

/// Finds the events of a run, batch by batch.
struct BatchFinder : EventFinder, OneThread {
  /// next: a changed scene that waits for its tick.
  BatchFinder(const Scene& scene, double given, const Scene* next) : EventFinder(scene), rate(given) {
    if (next) change(*next);
  }
  double rate;  // ticks per second, for runs without a time column
  std::uint64_t ticks = 0;

  static void archive(auto& self, auto& state) {
    EventFinder::archive(self, state);
    state.index(self.ticks, std::numeric_limits<std::uint64_t>::max());
  }
  void describe(auto& parameters) const {
    EventFinder::describe(parameters);
    parameters.fields(rate);
  }
  nb::tuple arguments() const {
    // Copies: another thread may change the scene while Python makes the tuple.
    const std::optional<Scene> next = waits_for_scene() ? std::optional(newest_scene()) : std::nullopt;
    return nb::make_tuple(Scene(scene()), rate, next ? nb::cast(*next) : nb::none());
  }
};

struct Found : Event {
  std::string name;
};

nb::dict as_dict(const Found& event) {
  static constexpr const char* words[] = {"touch", "pop", "out"};
  nb::dict d;
  d["what"] = words[static_cast<std::size_t>(event.what)];
  d["membrane"] = event.membrane;
  d["name"] = event.name;
  d["tick"] = event.tick;
  d["time"] = event.time;
  d["depth"] = event.depth;
  d["force_before"] = event.force_before;
  d["force_after"] = event.force_after;
  d["drop"] = event.drop();
  return d;
}

/// The phase of a code; 255, which is not a phase, for an invalid code.
Phase phase_of(double number) noexcept {
  return static_cast<Phase>(number >= 0 && number < 255 ? static_cast<std::uint8_t>(number) : std::uint8_t{255});
}

/// 0 for a number without bits, such as NaN.
std::uint32_t bits_of(double number) noexcept {
  return number >= 0 && number < 0x1p32 ? static_cast<std::uint32_t>(number) : 0;
}

/// Finds the events of a batch without holding the GIL. Throws ValueError for an event without time or depth; the
/// finder has then not taken the batch.
Object<"list[FoundEvent]"> add(BatchFinder& finder,
                               const Object<"Ticks | dict[str, numpy.typing.NDArray[typing.Any]]">& columns) {
  const Input depth = input(columns["depth"], "depth");
  if (depth.ndim() != 2) throw nb::value_error("columns[\"depth\"] must be (n, m)");
  const std::size_t n = depth.shape(0), m = depth.shape(1);
  const Column force(columns, "axial_force", n, m), phase(columns, "phase", n, m), lower(columns, "lower", n, m),
      direction(columns, "direction", n, 3 * m), axis(columns, "axis", n, 3), tick(columns, "tick", n, 1),
      time(columns, "time", n, 1), commands(columns, "commands", n, 1);
  if (!force || !phase) throw nb::key_error("columns must have \"depth\", \"axial_force\" and \"phase\"");

  std::vector<MembraneRecord> records(m);
  std::vector<Found> found;
  const OneThread::Running running(finder);
  const BatchFinder before = finder;
  {
    const WithoutLock without;
    for (std::size_t i = 0; i < n; ++i, ++finder.ticks) {
      for (std::size_t j = 0; j < m; ++j)
        records[j] = {.depth = depth.data()[i * m + j],
                      .axial_force = force(i, j),
                      .lower = lower(i, j),
                      .upper = nan,
                      .proxy = {},
                      .direction = direction.triple(i, j),
                      .phase = phase_of(phase(i, j))};
      const double given = tick(i);  // NaN in a batch without that column
      const auto number = given >= 0 && given < 0x1p63 ? static_cast<std::uint64_t>(given) : finder.ticks;
      // Without a commands column, the first tick of the batch takes the new scene.
      const auto asked = commands ? bits_of(commands(i)) : i == 0 ? command_scene : 0u;
      const double at = time ? time(i) : static_cast<double>(number) / finder.rate;
      for (const Event& event : finder.step(EventTick{number, at, axis.triple(i), asked, records}))
        found.push_back({event, finder.scene().membranes[event.membrane].name});
    }
  }
  nb::list events;
  for (const Found& event : found) {
    if (!std::isfinite(event.time) || !std::isfinite(event.depth)) {
      finder = before;
      throw value_error("tick " + std::to_string(event.tick) + ": " + (std::isfinite(event.time) ? "depth" : "time") +
                        " must be finite where an event is found. No tick of the batch was taken");
    }
    events.append(as_dict(event));
  }
  return events;
}

const PlacedMembrane& membrane_of(const Scene& scene, std::size_t i) {
  if (i >= scene.membranes.size()) throw nb::index_error(("the scene has no membrane " + std::to_string(i)).c_str());
  return scene.membranes[i];
}

std::array<double, 6> crossing_of(const Scene& scene, std::size_t i, double cos_beta) {
  const PlacedMembrane& placed = membrane_of(scene, i);
  const TissueLaw law(scene.needle, placed.membrane, placed.tissue);
  const Crossing c = crossing(law, scene.needle, placed.membrane.thickness, cos_beta);
  return {c.cos_beta, c.far_face, c.peak, c.through, c.again, c.shaft};
}

Object<"LawCurve"> law_curve_of(const Scene& scene, std::size_t i, double obliquity) {
  const PlacedMembrane& placed = membrane_of(scene, i);
  std::vector<Problem> problems;
  check_field(obliquity_field, obliquity, "", problems);
  raise_if(problems);
  const auto [far_face, through, curve] = membrane_law(scene, i, obliquity);
  nb::dict d;
  d["name"] = placed.name;
  d["obliquity"] = obliquity;
  d["far_face"] = far_face;
  d["through"] = through;
  d["depth"] = curve.depth;
  d["lower"] = curve.lower;
  d["upper"] = curve.upper;
  return d;
}

Floats obliquities(const Scene& scene, const ArrayLike& axis, const ArrayLike& entered) {
  const Rows axes(input(axis, "axis"), 1, "axis");
  const std::size_t n = scene.membranes.size();
  std::vector<double> angles(n);
  std::optional<Input> rows;
  if (!entered.is_none()) rows = points(entered, "entered");
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d held = rows && i < rows->shape(0) ? Vector3d(rows->data() + 3 * i) : Vector3d::Constant(nan);
    angles[i] = drawn_obliquity(scene, scene.membranes[i], axes[0], held);
  }
  return to_numpy(std::move(angles), {n});
}

}  // namespace

void bind_events(nb::module_& m) {
  m.def("crossing", &crossing_of, nb::arg("scene"), nb::arg("membrane"), nb::arg("cos_beta"),
        "The values of punctura.events.Crossing: cosine, depths (m) and force (N). Raises IndexError.");

  auto finder =
      nb::class_<BatchFinder>(m, "EventFinder", "Finds events in batches of ticks: punctura.events.EventFinder.");
  def_repr(finder, "<EventFinder at {0.rate:g} Hz>");
  def_state(finder);
  finder
      .def(nb::init<const Scene&, double, const Scene*>(), nb::arg("scene"), nb::arg("rate"),
           nb::arg("next") = nb::none())
      .def_ro("rate", &BatchFinder::rate, "Ticks a second of a run that does not tell the time, Hz")
      .def(
          "change",
          [](BatchFinder& finder, const Scene& scene) {
            finder.must_rest();
            finder.change(scene);
          },
          nb::arg("scene"))
      .def("add", &add, nb::arg("columns"),
           "Finds the events of the next ticks. Each is a dict of the arguments of punctura.events.Event.");

  m.def("law_curve", &law_curve_of, nb::arg("scene"), nb::arg("membrane"), nb::arg("obliquity"),
        "Phi_I and Phi_O (N) of one membrane over the depth (m), with points on both sides of each break, and the\n"
        "depth at which the needle comes out. obliquity: beta, rad.");
  m.def("obliquities", &obliquities, nb::arg("scene"), nb::arg("axis"), nb::arg("entered") = nb::none(),
        "Angle between the needle and each membrane's inward normal, (m,), rad, at most 85 degrees.\n\n"
        "axis (3,): direction of the stylus. entered (m, 3): the needle's direction at entry for each membrane that\n"
        "it is in, NaN for the others.");
  m.def(
      "tip_length", [](const Needle& needle) { return tip_length(needle); }, nb::arg("needle"),
      "Length of the slanted face along the needle, m: X.");
  m.attr("grazing_cosine") = grazing_cosine<double>;
}

}  // namespace punctura::bindings
