// core/punctura/events: what happens at the membranes, and the depths and curves of their laws.
#include "punctura/events/event_finder.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include "arguments.hpp"
#include "bindings.hpp"
#include "punctura/events/law_curve.hpp"
#include "state.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A column of a batch, with a number of doubles in each row. A batch without that column has NaN in it.
class Column {
 public:
  /// width: doubles in a row. Throws ValueError for another shape.
  Column(const nb::object& columns, const char* name, std::size_t rows, std::size_t width) : width_(width) {
    if (!nb::cast<bool>(columns.attr("__contains__")(name))) return;
    array_ = input(columns[name]);
    if (array_->ndim() == 0 || array_->shape(0) != rows || array_->size() != rows * width)
      throw nb::value_error(("columns[\"" + std::string(name) + "\"] must have " + std::to_string(rows) + " rows of " +
                             std::to_string(width) + " numbers, as columns[\"depth\"] has")
                                .c_str());
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

/// The columns of a batch that a finder reads.
class Batch {
 public:
  explicit Batch(const nb::object& columns)
      : depth_(input(columns["depth"])),
        n_(depth_.ndim() == 2 ? depth_.shape(0) : throw nb::value_error("columns[\"depth\"] must be (n, m)")),
        m_(depth_.shape(1)),
        force_(columns, "axial_force", n_, m_),
        lower_(columns, "lower", n_, m_),
        phase_(columns, "phase", n_, m_),
        direction_(columns, "direction", n_, 3 * m_),
        axis_(columns, "axis", n_, 3),
        tick_(columns, "tick", n_, 1),
        time_(columns, "time", n_, 1),
        commands_(columns, "commands", n_, 1),
        records_(m_) {
    if (!force_ || !phase_) throw nb::key_error("columns must have \"depth\", \"axial_force\" and \"phase\"");
  }

  std::size_t size() const noexcept { return n_; }

  /// Row i, the number-th tick of the run. new_scene: where no column tells in which tick a new scene came.
  EventTick tick(std::size_t i, std::uint64_t number, double rate, bool new_scene) noexcept {
    for (std::size_t j = 0; j < m_; ++j) {
      const auto phase = static_cast<std::uint8_t>(phase_(i, j));
      records_[j] = {depth_.data()[i * m_ + j], force_(i, j), lower_(i, j), nan, {}, direction_.triple(i, j),
                     static_cast<Phase>(phase)};
    }
    if (tick_) number = static_cast<std::uint64_t>(tick_(i));
    const std::uint32_t otherwise = new_scene ? std::uint32_t{command_scene} : 0;
    return {number, time_ ? time_(i) : static_cast<double>(number) / rate, axis_.triple(i),
            commands_ ? static_cast<std::uint32_t>(commands_(i)) : otherwise, records_};
  }

 private:
  Input depth_;
  std::size_t n_, m_;
  Column force_, lower_, phase_, direction_, axis_, tick_, time_, commands_;
  std::vector<MembraneRecord> records_;
};

/// A finder that takes a run batch by batch.
struct BatchFinder : EventFinder, OneThread {
  BatchFinder(const Scene& scene, double given) : EventFinder(scene), rate(given) {}
  double rate;  // ticks a second, for runs that do not tell the time
  std::uint64_t ticks = 0;
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

nb::list add(BatchFinder& finder, const nb::object& columns) {
  Batch batch(columns);
  std::vector<Found> found;
  {
    const OneThread::Running running(finder);
    nb::gil_scoped_release release;
    for (std::size_t i = 0; i < batch.size(); ++i)
      for (const Event& event : finder.step(batch.tick(i, finder.ticks++, finder.rate, i == 0)))
        found.push_back({event, finder.scene().membranes[event.membrane].name});
  }
  nb::list events;
  for (const Found& event : found) events.append(as_dict(event));
  return events;
}

const PlacedMembrane& membrane_of(const Scene& scene, std::size_t i) {
  if (i >= scene.membranes.size()) throw nb::index_error(("the scene has no membrane " + std::to_string(i)).c_str());
  return scene.membranes[i];
}

Crossing crossing_of(const Scene& scene, std::size_t i, double cos_beta) {
  const Membrane& membrane = membrane_of(scene, i).membrane;
  return crossing(ThickLaw(scene.needle, membrane), scene.needle, membrane.thickness, cos_beta);
}

Crossing make_crossing(double cos_beta, double far_face, double peak, double through, double again, double shaft) {
  return {cos_beta, far_face, peak, through, again, shaft};
}

nb::dict law_curve_of(const Scene& scene, std::size_t i, double obliquity) {
  const PlacedMembrane& placed = membrane_of(scene, i);
  std::vector<Problem> problems;
  check_field(obliquity_field, obliquity, "", problems);
  raise_if(problems);
  const ThickLaw law(scene.needle, placed.membrane, obliquity);
  const LawCurve curve = law_curve(law.pieces());
  nb::dict d;
  d["name"] = placed.name;
  d["obliquity"] = obliquity;
  d["far_face"] = law.path_length();
  d["through"] = law.pieces().breaks.back();
  d["depth"] = curve.depth;
  d["lower"] = curve.lower;
  d["upper"] = curve.upper;
  return d;
}

nb::object drawn_obliquities(const Scene& scene, const nb::object& axis, const nb::object& entered) {
  const Rows axes(input(axis), 1, "axis");
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
  auto turns =
      nb::class_<Crossing>(m, "Crossing", "The depths along the needle at which its way through a membrane turns, m.")
          .def_ro("cos_beta", &Crossing::cos_beta, "n.b, of the needle's direction at entry")
          .def_ro("far_face", &Crossing::far_face, "The tip's point comes out behind: U")
          .def_ro("peak", &Crossing::peak, "The resistance -Phi_I is largest")
          .def_ro("through", &Crossing::through, "The slanted face is out behind, too; only the shaft rubs: X + U")
          .def_ro("again", &Crossing::again, "A tip that has come back to here can pop again")
          .def_ro("shaft", &Crossing::shaft, "Resistance of the shaft alone, N: F U / H");
  def_init(turns,
           {{"cos_beta", "float"},
            {"far_face", "float"},
            {"peak", "float"},
            {"through", "float"},
            {"again", "float"},
            {"shaft", "float"}},
           &make_crossing, "Made by crossing().");
  def_value(turns, {"cos_beta", "far_face", "peak", "through", "again", "shaft"});
  m.def("crossing", &crossing_of, nb::arg("scene"), nb::arg("membrane"), nb::arg("cos_beta"),
        "Of one membrane of a scene, by its number, for a needle with n.b = cos_beta. Raises IndexError.");

  nb::class_<BatchFinder>(m, "EventFinder", "Finds events in batches of ticks: punctura.events.EventFinder.")
      .def(nb::init<const Scene&, double>(), nb::arg("scene"), nb::arg("rate"))
      .def(
          "change",
          [](BatchFinder& finder, const Scene& scene) {
            finder.must_rest();
            finder.change(scene);
          },
          nb::arg("scene"))
      .def("add", &add, nb::arg("columns"),
           nb::sig("def add(self, columns: Mapping[str, numpy.typing.ArrayLike]) -> list[dict[str, typing.Any]]"),
           "Each event as the arguments of punctura.events.Event.");

  m.def(
      "law_curve", &law_curve_of, nb::arg("scene"), nb::arg("membrane"), nb::arg("obliquity"),
      nb::sig("def law_curve(scene: Scene, membrane: int, obliquity: float) -> dict[str, typing.Any]"),
      "Phi_I and Phi_O of one membrane along the depth, m and N, with both sides of each break; and where the needle comes out.");
  m.def(
      "drawn_obliquities", &drawn_obliquities, nb::arg("scene"), nb::arg("axis"), nb::arg("entered") = nb::none(),
      nb::sig(
          "def drawn_obliquities(scene: Scene, axis: numpy.typing.ArrayLike, entered: numpy.typing.ArrayLike | None "
          "= None) -> numpy.typing.NDArray[numpy.float64]"),
      "Angle of the needle to each membrane's inward normal, rad, at most 85 degrees, (m,). axis (3,): of the stylus. entered "
      "(m, 3): the direction of each membrane that the needle is in, NaN in the others.");
  m.def("tip_length", &tip_length<double>, nb::arg("needle"), "Length of the slanted face along the needle, m: X.");
  m.attr("grazing_cosine") = grazing_cosine<double>;
}

}  // namespace punctura::bindings
