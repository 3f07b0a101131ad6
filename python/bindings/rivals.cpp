// core/punctura/rivals: force models of other authors, alone, in a scene, and in a simulated hand.
#include "bindings.hpp"
#include "motion.hpp"
#include "punctura/rivals/rival_insertion.hpp"
#include "run_in_space.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

/// Sets the numbers of a rival. Throws ConfigurationError with all problems.
AnyRival made(const std::string& name, const nb::dict& numbers) {
  std::string known;
  nb::list names;
  const auto add = [&](const char* one) { known += std::string(known.empty() ? "" : ", ") + one; };
  std::optional<AnyRival> rival = AnyRival::named(name);
  if (!rival) {
    AnyRival::for_each_kind([&](const auto& r) { add(r.name), names.append(nb::str(r.name)); });
    raise_word("rival", name, ("must be one of " + known + nearest(name, names)).c_str());
  }
  rival->visit([&](auto& run) {
    const auto all = run.rival.numbers();
    for (const auto& number : all) add(number.name);
    for (const auto& [key, given] : numbers) {
      const std::string word = nb::str(key).c_str(), path = name + "." + word;
      const auto number = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == word; });
      if (number == all.end()) raise_word(path, word, ("is not a parameter of this rival. It has " + known).c_str());
      double& value = run.rival.*number->value;
      if (!nb::try_cast(given, value)) throw type_error(path + " must be a number");
    }
  });
  std::vector<Problem> problems;
  check(*rival, name, problems);
  raise_if(problems);
  return *rival;
}

Object<"dict[str, float]"> numbers_of(const AnyRival& rival) {
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

Floats resistance(const AnyRival& rival, const ArrayLike& depth, const ArrayLike& velocity, const ArrayLike& period) {
  const Path path(depth, velocity, period);
  std::vector<double> force(path.n);
  rival.visit([&](auto run) {
    run.state = {};
    for (std::size_t i = 0; i < path.n; ++i)
      force[i] = run.step(path.depth.data()[i], path.velocity.data()[i], path.at(i));
  });
  return to_numpy(std::move(force), {path.n});
}

/// load() at each row of a layer that is never punctured; 0 in front of it.
Floats loads(const AnyRival& rival, const ArrayLike& depth, const ArrayLike& velocity, const ArrayLike& period) {
  const Path path(depth, velocity, period);
  std::vector<double> load(path.n);
  rival.visit([&](auto run) {
    if constexpr (Punctures<decltype(run.rival)>) {
      run.state = {};
      run.rival.puncture = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < path.n; ++i) {
        const double here = path.depth.data()[i];
        run.step(here, path.velocity.data()[i], path.at(i));
        load[i] = here > 0 ? run.rival.load(run.state, here) : 0;
      }
    } else {
      throw value_error(std::string(run.rival.name) + " has no puncture");
    }
  });
  return to_numpy(std::move(load), {path.n});
}

Object<"list[dict[str, typing.Any]]"> kinds() {
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
      one["shows"] = Word(number.shows);
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

/// A scene with rivals that keeps its arguments.
struct SceneRivals : RivalInsertion, OneThread {
  SceneRivals(const Scene& given, const std::vector<AnyRival>& given_rivals)
      : RivalInsertion(
            detail::or_throw([&](auto& problems) { return try_build_rivals(given, given_rivals, problems); })),
        scene(given),
        rivals(given_rivals) {}
  Scene scene;
  std::vector<AnyRival> rivals;

  nb::tuple arguments() const { return nb::make_tuple(scene, rivals); }
};

TicksObject experiment(const Scene& scene, const std::vector<AnyRival>& rivals, const AnyMotion& motion,
                       double duration, const DeviceDynamics& plant, const Hand& hand, std::uint64_t seed,
                       const ProgressArgument& progress) {
  const RivalServoStep step = build_rivals(scene, rivals);
  const double rate = scene.servo.rate;
  const std::size_t n = ticks_in(duration, rate);
  const Vector3d axis = unit(scene.membranes.front().inward_normal, "axis");
  return std::visit(
      [&]<typename Motion>(Motion motion) {
        Experiment<Motion, RivalServoStep> made(step, 1 / rate, std::move(motion), axis, plant, hand, seed);
        return run_experiment(made, n, progress);
      },
      laid_out(motion, seed));
}

void bind_rival(nb::module_& m) {
  auto rival = nb::class_<AnyRival>(m, "Rival", nb::is_final(),
                                    "A force model of another author, with its numbers. docs/rivals.md");
  def_fields(rival, {"name", "numbers"});
  def_repr(rival, "Rival({0.name!r}, {0.numbers!r})");
  rival
      .def(
          "__init__",
          [](AnyRival* self, const std::string& name, const Object<"dict[str, float]">& numbers) {
            nb::dict given;
            given.attr("update")(numbers);
            new (self) AnyRival(made(name, given));
          },
          nb::arg("name"), nb::arg("numbers") = nb::dict(),
          "numbers: by name, SI; a number that is not given has its default. Raises ConfigurationError.")
      .def_prop_ro(
          "name",
          [](const AnyRival& r) { return r.visit([](const auto& run) { return std::string(run.rival.name); }); })
      .def_prop_ro("numbers", &numbers_of, "By name, SI")
      .def("__hash__",
           [](nb::handle self) {
             return nb::hash(nb::make_tuple(self.attr("name"), nb::tuple(self.attr("numbers").attr("items")())));
           })
      .def("resistance", &resistance, nb::arg("depth"), nb::arg("velocity"), nb::arg("period"),
           "The force against the insertion (n,), N, of an untouched layer.\n\n"
           "depth (n,): m below the surface. velocity (n,): m/s, inwards. period (n,) or a number: s since the row\n"
           "before. Raises ValueError.")
      .def("loads", &loads, nb::arg("depth"), nb::arg("velocity"), nb::arg("period"),
           "What is compared with the number `puncture`, (n,), if the layer is never punctured. Arguments as of\n"
           "resistance(). Raises ValueError if the rival has no puncture.");
  m.def("rival_kinds", &kinds, "Name, title, source and numbers of each rival.");
}

}  // namespace

void bind_rivals(nb::module_& m) {
  bind_rival(m);
  auto scene = nb::class_<SceneRivals>(
      m, "RivalInsertion", nb::is_final(),
      "A needle through all membranes of a scene, with a rival in place of K06's law in each. The same conditioning\n"
      "of the position. Gives the model's force without safety limits.");
  def_state(scene);
  def_reset(scene);
  def_repr(scene, "<RivalInsertion in {0.scene.name!r}>");
  scene
      .def(nb::init<Scene, std::vector<AnyRival>>(), nb::arg("scene"), nb::arg("rivals"),
           "rivals: one, or one for each membrane. Raises ConfigurationError or ValueError.")
      .def_ro("scene", &SceneRivals::scene)
      .def_prop_ro("rivals", [](const SceneRivals& self) { return self.rivals; });
  def_run_in_space(scene, {"position", "axis", "tip", "force", "depth", "axial_force", "lower", "upper", "phase"},
                   "Makes n ticks from the present state on. Arguments as of Insertion.run().");
  m.def("rival_experiment", &experiment, nb::arg("scene"), nb::arg("rivals"), nb::arg("motion"), nb::arg("duration"),
        nb::arg("plant") = DeviceDynamics{}, nb::arg("hand") = Hand{}, nb::arg("seed") = 0, nb::kw_only(),
        nb::arg("progress") = nb::none(),
        "A simulated operator at a simulated device, as in Experiment, with rivals in place of K06's law: the same\n"
        "gate, limits, device and hand. duration: s. Raises ConfigurationError or ValueError.");
}

}  // namespace punctura::bindings
