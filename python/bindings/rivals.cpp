// core/punctura/rivals: force models of other authors, alone, in a scene, and in a simulated hand.
#include <nanobind/stl/variant.h>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura/rivals/rival_insertion.hpp"
#include "state.hpp"
#include "tick_columns.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

const char* word(Shows shows) {
  switch (shows) {
    case Shows::insertion: return "insertion";
    case Shows::withdrawal: return "withdrawal";
    case Shows::speeds: return "speeds";
    default: return "nothing";
  }
}

/// Sets the numbers of a rival. Throws ConfigurationError with all problems.
AnyRival made(const std::string& name, const nb::dict& numbers) {
  std::optional<AnyRival> rival = AnyRival::named(name);
  if (!rival) {
    std::string known;
    AnyRival::for_each_kind([&](const auto& r) { known += std::string(known.empty() ? "" : ", ") + r.name; });
    raise_word("rival", name, ("must be one of " + known).c_str());
  }
  std::vector<Problem> problems;
  rival->visit([&](auto& run) {
    std::size_t used = 0;
    for (const auto& number : run.rival.numbers()) {
      if (!numbers.contains(number.name)) continue;
      ++used;
      const double value = nb::cast<double>(numbers[number.name]);
      if (!(value >= number.low && value <= number.high))
        problems.push_back(
            {name + "." + number.name, value,
             nb::cast<std::string>(
                 nb::str("must be between {:g} and {:g} {}").attr("format")(number.low, number.high, number.unit))});
      run.rival.*number.value = value;
    }
    if (used == numbers.size()) return;
    std::string known;
    for (const auto& number : run.rival.numbers()) known += std::string(known.empty() ? "" : ", ") + number.name;
    for (const auto& [key, value] : numbers)
      if (("," + std::string(" ") + known + ",").find(" " + nb::cast<std::string>(key) + ",") == std::string::npos)
        raise_word(name + "." + nb::cast<std::string>(key), nb::cast<std::string>(key),
                   ("is not a parameter of this rival. It has " + known).c_str());
  });
  raise_if(problems);
  return *rival;
}

nb::dict numbers_of(const AnyRival& rival) {
  nb::dict all;
  rival.visit([&](const auto& run) {
    for (const auto& number : run.rival.numbers()) all[number.name] = run.rival.*number.value;
  });
  return all;
}

/// depth, velocity: (n,). period: (n,) or a number.
struct Path {
  Path(const nb::object& depths, const nb::object& velocities, const nb::object& periods)
      : depth(input_1d(depths, "depth")),
        velocity(input_1d(velocities, "velocity")),
        period(input(periods, "period")),
        n(depth.size()) {
    if (velocity.size() != n) throw nb::value_error("velocity must have one value for each depth");
    if (period.ndim() > 1 || (period.size() != 1 && period.size() != n))
      throw nb::value_error("period must be a number, or have one value for each depth");
    check_finite(depth.data(), n, "depth", 1);
    check_finite(velocity.data(), n, "velocity", 1);
    check_finite(period.data(), period.size(), "period", 1);
  }
  double at(std::size_t i) const noexcept { return period.data()[period.size() == 1 ? 0 : i]; }

  Input depth, velocity, period;
  std::size_t n;
};

nb::object resistance(const AnyRival& rival, const Path& path) {
  std::vector<double> force(path.n);
  rival.visit([&](auto run) {
    run.state = {};
    for (std::size_t i = 0; i < path.n; ++i)
      force[i] = run.step(path.depth.data()[i], path.velocity.data()[i], path.at(i));
  });
  return to_numpy(std::move(force), {path.n});
}

/// load() at each row of a layer that is never punctured; 0 in front of it.
nb::object loads(const AnyRival& rival, const Path& path) {
  std::vector<double> load(path.n);
  rival.visit([&](auto run) {
    if constexpr (Punctures<decltype(run.rival)>) {
      run.state = {};
      run.rival.puncture = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < path.n; ++i) {
        const double depth = path.depth.data()[i];
        run.step(depth, path.velocity.data()[i], path.at(i));
        load[i] = depth > 0 ? run.rival.load(run.state, depth) : 0;
      }
    } else {
      throw nb::value_error((std::string(run.rival.name) + " has no puncture").c_str());
    }
  });
  return to_numpy(std::move(load), {path.n});
}

nb::list kinds() {
  nb::list all;
  AnyRival::for_each_kind([&]<typename R>(const R& rival) {
    nb::list numbers;
    for (const auto& number : R::numbers()) {
      nb::dict one;
      one["name"] = number.name;
      one["unit"] = number.unit;
      one["low"] = number.low;
      one["high"] = number.high;
      one["default"] = rival.*number.value;
      one["what"] = number.what;
      one["shows"] = word(number.shows);
      numbers.append(one);
    }
    nb::dict kind;
    kind["name"] = R::name;
    kind["title"] = R::title;
    kind["source"] = R::source;
    kind["punctures"] = Punctures<R>;
    kind["numbers"] = numbers;
    all.append(kind);
  });
  return all;
}

RivalInsertion built(const Scene& scene, const std::vector<AnyRival>& rivals) {
  std::vector<Problem> problems;
  auto made = try_build_rivals(scene, rivals, problems);
  raise_if(problems);
  return std::move(*made);
}

/// A scene with rivals that keeps its arguments.
struct SceneRivals : OneThread {
  SceneRivals(const Scene& given, const std::vector<AnyRival>& given_rivals)
      : scene(given), rivals(given_rivals), insertion(built(scene, rivals)) {}
  Scene scene;
  std::vector<AnyRival> rivals;
  RivalInsertion insertion;

  std::vector<std::byte> save() const { return save_state(insertion); }
  bool load(std::span<const std::byte> state) { return load_state(insertion, state); }
  nb::tuple arguments() const { return nb::make_tuple(scene, rivals); }
};

nb::object run(SceneRivals& self, const nb::object& positions, const nb::object& axis, const nb::object& progress) {
  const auto count = static_cast<std::uint32_t>(self.insertion.size());
  SnapshotColumns columns({"position", "axis", "tip", "force", "depth", "axial_force", "lower", "upper", "phase"});
  columns.reserve(nb::len_hint(positions), count);  // before the positions are copied
  const Input p = points(positions, "p");
  const std::size_t n = p.shape(0);
  const Rows axes(input(axis, "axis"), n, "axis");
  check_places(p.data(), 3 * n, "p", 3);
  if (self.insertion.uses_axis()) axes.check("axis");
  Snapshot record{};
  record.membrane_count = count;
  const OneThread::Running running(self);
  const auto tick = [&](std::size_t i) {
    const Vector3d position(p.data() + 3 * i), direction = axes[i].stableNormalized();
    record.sample.position = to_array(position);
    record.sample.axis = to_array(direction);
    record.force = to_array(self.insertion.step(position, direction));
    record.tip = to_array(self.insertion.tip());
    for (std::size_t j = 0; j < count; ++j) record.membranes[j] = record_of(self.insertion.tick(j));
    columns.add(record);
  };
  make_ticks(n, tick, progress);
  return columns.to_ticks();
}

using AnyMotion = std::variant<Strokes, RecordedMotion, Target>;

nb::object experiment(const Scene& scene, const std::vector<AnyRival>& rivals, const AnyMotion& motion, double duration,
                      const DeviceDynamics& plant, const Hand& hand, std::uint64_t seed, const nb::object& progress) {
  built(scene, rivals);  // raises all problems
  if (!(duration >= 0 && duration <= 1e9)) throw nb::value_error("duration must be from 0 to 1e9 s");
  const auto n = static_cast<std::size_t>(std::llround(duration * scene.servo.rate));
  const Vector3d axis = unit(scene.membranes.front().inward_normal, "axis");
  const auto made = [&](auto laid_out) {
    using Motion = decltype(laid_out);
    Experiment<Motion, RivalServoStep> one(build_rivals(scene, rivals), 1 / scene.servo.rate, std::move(laid_out), axis,
                                           plant, hand, seed);
    ExperimentColumns columns;
    columns.reserve(n, scene.membranes.size());
    make_ticks(
        n,
        [&](std::size_t) {
          const Snapshot& snapshot = one.step();
          columns.add(snapshot, one.extra());
        },
        progress);
    return columns.to_ticks();
  };
  if (const auto* strokes = std::get_if<Strokes>(&motion)) return made(StrokesMotion(*strokes, seed));
  if (const auto* recorded = std::get_if<RecordedMotion>(&motion)) return made(*recorded);
  return made(std::get<Target>(motion));
}

void bind_rival(nb::module_& m) {
  auto rival = nb::class_<AnyRival>(m, "Rival", nb::is_final(),
                                    "A force model of another author, with its numbers. docs/rivals.md");
  rival
      .def(
          "__init__",
          [](AnyRival* self, const std::string& name, const nb::object& numbers) {
            nb::dict given;
            given.attr("update")(numbers);
            new (self) AnyRival(made(name, given));
          },
          nb::arg("name"), nb::arg("numbers") = nb::dict(),
          nb::sig("def __init__(self, name: str, numbers: dict[str, float] = ...) -> None"),
          "numbers: by name, SI; a number that is not given has its default. Raises ConfigurationError.")
      .def_prop_ro(
          "name",
          [](const AnyRival& r) { return r.visit([](const auto& run) { return std::string(run.rival.name); }); })
      .def_prop_ro("numbers", &numbers_of, nb::sig("def numbers(self) -> dict[str, float]"), "By name, SI")
      .def("__repr__",
           [](nb::handle self) {
             return "Rival(" + nb::cast<std::string>(nb::repr(self.attr("name"))) + ", " +
                    nb::cast<std::string>(nb::repr(self.attr("numbers"))) + ")";
           })
      .def(
          "__eq__",
          [](const AnyRival& self, nb::handle other) {
            return nb::isinstance<AnyRival>(other) &&
                   nb::cast<nb::object>(nb::cast(self).attr("name")).equal(other.attr("name")) &&
                   numbers_of(self).equal(other.attr("numbers"));
          },
          nb::sig("def __eq__(self, other: object, /) -> bool"))
      .def("__hash__",
           [](nb::handle self) {
             return nb::hash(nb::make_tuple(self.attr("name"), nb::tuple(self.attr("numbers").attr("items")())));
           })
      .def(
          "__reduce__",
          [](nb::handle self) {
            return nb::make_tuple(self.type(), nb::make_tuple(self.attr("name"), self.attr("numbers")));
          },
          nb::sig("def __reduce__(self) -> tuple[type, tuple[typing.Any, ...]]"))
      .def(
          "resistance",
          [](const AnyRival& self, const nb::object& depth, const nb::object& velocity, const nb::object& period) {
            return resistance(self, Path(depth, velocity, period));
          },
          nb::arg("depth"), nb::arg("velocity"), nb::arg("period"),
          nb::sig("def resistance(self, depth: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, "
                  "period: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
          "The force against the insertion (n,), N, of an untouched layer.\n\n"
          "depth (n,): m below the surface. velocity (n,): m/s, inwards. period (n,) or a number: s since the row\n"
          "before. Raises ValueError.")
      .def(
          "loads",
          [](const AnyRival& self, const nb::object& depth, const nb::object& velocity, const nb::object& period) {
            return loads(self, Path(depth, velocity, period));
          },
          nb::arg("depth"), nb::arg("velocity"), nb::arg("period"),
          nb::sig("def loads(self, depth: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, "
                  "period: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
          "What is compared with the number `puncture`, (n,), if the layer is never punctured. Arguments as of\n"
          "resistance(). Raises ValueError if the rival has no puncture.");
  m.def("rival_kinds", &kinds, nb::sig("def rival_kinds() -> list[dict[str, typing.Any]]"),
        "Name, title, source and numbers of each rival.");
}

}  // namespace

void bind_rivals(nb::module_& m) {
  bind_rival(m);
  auto scene = nb::class_<SceneRivals>(
      m, "RivalInsertion", nb::is_final(),
      "A needle through all membranes of a scene, with a rival in place of K06's law in each. The same conditioning\n"
      "of the position. Gives the model's force without safety limits.");
  def_state(scene);
  def_repr(scene, "<RivalInsertion in {0.scene.name!r}>");
  scene
      .def(
          "__init__",
          [](SceneRivals* self, const Scene& given, const std::vector<AnyRival>& rivals) {
            new (self) SceneRivals(given, rivals);
          },
          nb::arg("scene"), nb::arg("rivals"),
          nb::sig("def __init__(self, scene: Scene, rivals: Sequence[Rival]) -> None"),
          "rivals: one, or one for each membrane. Raises ConfigurationError or ValueError.")
      .def_ro("scene", &SceneRivals::scene)
      .def_prop_ro("rivals", [](const SceneRivals& self) { return self.rivals; })
      .def(
          "reset",
          [](SceneRivals& self) {
            self.must_rest();
            self.insertion.reset();
          },
          "Resets to the state before the first tick.")
      .def("run", &run, nb::arg("p"), nb::arg("axis"), nb::kw_only(), nb::arg("progress") = nb::none(),
           nb::sig("def run(self, p: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike, *, "
                   "progress: Progress = None) -> Ticks"),
           "Makes n ticks from the present state on. Arguments as of Insertion.run().");
  m.def(
      "rival_experiment", &experiment, nb::arg("scene"), nb::arg("rivals"), nb::arg("motion"), nb::arg("duration"),
      nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{}, nb::arg("seed") = 0, nb::kw_only(),
      nb::arg("progress") = nb::none(),
      nb::sig("def rival_experiment(scene: Scene, rivals: Sequence[Rival], motion: Strokes | RecordedMotion | Target, "
              "duration: float, plant: Plant = ..., hand: Hand = ..., seed: int = 0, *, "
              "progress: Progress = None) -> Ticks"),
      "A simulated operator at a simulated device, as in Experiment, with rivals in place of K06's law: the same\n"
      "gate, limits, device and hand. duration: s. Raises ConfigurationError or ValueError.");
}

}  // namespace punctura::bindings
