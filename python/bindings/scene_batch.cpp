// runtime/punctura_runtime/batch/scene_batch.hpp: many runs of a scene in SIMD lanes and on threads.
#include "punctura_runtime/batch/scene_batch.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/variant.h>

#include <algorithm>

#include "bindings.hpp"
#include "simd_code.hpp"
#include "ticks.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

using batch::SceneBatch;

/// Takes over the motion. `kept` holds the arrays of positions.
SceneBatch::Motion motion_of(const nb::object& given, const nb::object& axis, std::size_t trials,
                             std::vector<Input>& kept) {
  if (nb::isinstance<Strokes>(given)) return nb::cast<Strokes>(given);
  if (nb::isinstance<RecordedMotion>(given)) return nb::cast<RecordedMotion>(given);
  const Input p = input(given, "motion");
  const bool each = p.ndim() == 3 && p.shape(0) == trials && p.shape(2) == 3;
  if (!each && !(p.ndim() == 2 && p.shape(1) == 3))
    throw value_error("motion must be Strokes, a RecordedMotion, or positions of shape (ticks, 3) or (" +
                      std::to_string(trials) + ", ticks, 3)");
  const std::size_t ticks = p.shape(each ? 1 : 0);
  check_places(p.data(), p.size(), "motion", 3);
  const Input a = input(axis, "axis");
  Rows(a, ticks, "axis").check("axis");
  kept = {p, a};
  return batch::Positions{p.data(), each ? static_cast<std::ptrdiff_t>(3 * ticks) : 0, a.data(), a.ndim() == 1 ? 0 : 3,
                          ticks};
}

Columns run_scenes(const Scene& scene, const Object<"typing.Any">& motion,
                   const nb::typed<nb::dict, std::string, Floats>& vary, std::size_t trials,
                   const Object<"typing.Any">& axis, const DeviceDynamics& plant, const Hand& hand,
                   const Object<"numpy.typing.NDArray[numpy.uint64]">& seeds, double duration, bool keep_force,
                   const Object<"int">& threads, const std::optional<std::string>& instructions,
                   const ProgressArgument& progress) {
  std::vector<Input> kept;
  SceneBatch all{.scene = scene,
                 .motion = motion_of(motion, axis, trials, kept),
                 .trials = trials,
                 .plant = plant,
                 .hand = hand,
                 .duration = duration};
  const auto* positions = std::get_if<batch::Positions>(&all.motion);
  if (!positions) all.axis = unit(nb::cast<Triple>(axis), "axis");
  const auto given = nb::cast<nb::ndarray<const std::uint64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>>(seeds);
  all.seeds.assign(given.data(), given.data() + given.size());
  for (nb::handle item : vary.items()) {
    const auto path = nb::cast<std::string>(item[0]);
    const Input values = input_1d(nb::borrow(item[1]), path.c_str());
    all.varied.push_back({path, {values.data(), values.data() + values.size()}});
    if (values.size() != trials) throw value_error(path + ": one value for each trial is needed");
  }
  if (all.seeds.size() != trials) throw nb::value_error("seeds: one for each trial is needed");

  const Progress reporter(progress);
  const batch::RunOptions options = options_of(threads, instructions, reporter);
  batch::SceneResults results;
  std::optional<batch::TrialProblems> wrong;
  std::vector<double> force;
  std::size_t ticks = 0;
  if (keep_force) {
    ticks = positions ? positions->ticks : static_cast<std::size_t>(std::llround(duration * scene.servo.rate));
    force.resize(3 * trials * ticks);
    results.force = force.data();
  }
  const std::vector<std::string> known = batch::paths(all);
  for (const auto& [path, values] : all.varied) {
    if (std::find(known.begin(), known.end(), path) != known.end()) continue;
    const std::string near = nearest(path, nb::cast<nb::list>(nb::cast(known)));
    throw value_error("vary: this batch has no number " + path + (near.empty() ? "." : near) +
                      " scene.fields() lists those of the scene; hand, plant and strokes have theirs, as in "
                      "\"hand.stiffness\"");
  }
  {
    const WithoutLock without;
    wrong = batch::check(all, options);
    if (!wrong) batch::run(all, results, options);
  }
  if (wrong) {
    for (Problem& problem : wrong->problems)
      problem.path = "trial " + std::to_string(wrong->trial) + ": " + problem.path;
    raise_if(wrong->problems);
  }
  reporter.report(1, 1);
  const std::vector<std::size_t> of_membrane{trials, scene.membranes.size()};
  using R = batch::RunNumbers;
  using M = batch::MembraneNumbers;
  nb::dict d;
  d["peak"] = column(results.runs, &R::peak);
  d["felt_peak"] = column(results.runs, &R::felt_peak);
  d["depth"] = column(results.runs, &R::depth);
  d["work"] = column(results.runs, &R::work);
  d["dwell"] = column(results.runs, &R::dwell);
  d["limited"] = column(results.runs, &R::limited);
  d["fault"] = column(results.runs, &R::fault);
  d["in_lanes"] = column(results.runs, &R::in_lanes);
  d["pops"] = column(results.membranes, &M::pops, of_membrane);
  d["first_pop"] = column(results.membranes, &M::first_pop, of_membrane);
  d["drop"] = column(results.membranes, &M::drop, of_membrane);
  d["overshoot"] = column(results.membranes, &M::overshoot, of_membrane);
  if (keep_force) d["force"] = to_numpy(std::move(force), {trials, ticks, 3});
  return d;
}

}  // namespace

void bind_scene_batch(nb::module_& m) {
  m.def(
      "real_numbers",
      [](const Object<"typing.Any">& given, const std::string& name) -> Floats {
        return real_numbers(given, name.c_str());
      },
      nb::arg("given"), nb::arg("name"),
      "The numbers of an argument as float64. Raises TypeError and ValueError, which name the argument.");
  m.def(
      "batch_paths", [](const Scene& scene) { return batch::paths({.scene = scene, .motion = Strokes{}}); },
      nb::arg("scene"), "Paths of the numbers that punctura.batch() can vary, with strokes at a simulated device.");
  m.def("run_scenes", &run_scenes, nb::arg("scene"), nb::arg("motion"), nb::arg("vary"), nb::arg("trials"),
        nb::arg("axis"), nb::arg("plant"), nb::arg("hand"), nb::arg("seeds"), nb::arg("duration"),
        nb::arg("keep_force"), nb::arg("threads").none(), nb::arg("instructions").none(), nb::arg("progress").none(),
        "The runs of punctura.batch(). Raises ConfigurationError, ValueError.");
}

}  // namespace punctura::bindings
