// core/punctura/proxy/insertion: the whole model of a scene, from positions to forces.
#include "punctura/proxy/insertion.hpp"

#include "bindings.hpp"
#include "insertion_trace.hpp"
#include "punctura/scene/build.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

InsertionTrace run(Insertion& insertion, const nb::object& positions, const nb::object& axis) {
  const Input p = points(positions, "p");
  const std::size_t n = p.shape(0);
  const Rows axes(input(axis), n, "axis");
  check_finite(p.data(), 3 * n, "p", 3);
  if (insertion.uses_axis()) axes.check("axis");
  MembraneColumns columns(n, insertion.proxies().size());
  std::vector<double> force(3 * n);
  make_ticks(n, [&](std::size_t i) {
    const Vector3d now = insertion.step(Vector3d(p.data() + 3 * i), axes[i].stableNormalized());
    std::copy(now.begin(), now.end(), &force[3 * i]);
    for (std::size_t j = 0; j < insertion.proxies().size(); ++j) {
      const auto& tick = insertion.proxies()[j].tick();
      columns.set(i, j, tick.depth, tick.axial_force, tick.band.lower, tick.band.upper, tick.phase);
    }
  });
  return {to_numpy(std::move(force), {n, 3}), std::move(columns)};
}

}  // namespace

void bind_insertion(nb::module_& m) {
  auto trace = nb::class_<InsertionTrace>(m, "InsertionTrace", "What a run gave, tick by tick; n ticks, m membranes.");
  trace.def_prop_ro(
      "force", [](const InsertionTrace& t) { return t.force; },
      nb::sig("def force(self) -> numpy.typing.NDArray[numpy.float64]"), "On the device, (n, 3), N");
  def_membrane_columns(trace);

  nb::class_<Insertion>(
      m, "Insertion",
      "A needle through all membranes of a scene: position conditioning, one proxy a membrane, their sum. K06 (41), Fig. 8\n\n"
      "The model's own force: no safety limits.")
      .def(
          "__init__",
          [](Insertion* self, const Scene& scene) {
            raise_if(check(scene));
            new (self) Insertion(build_insertion(scene));
          },
          nb::arg("scene"), "Raises ConfigurationError with all problems of the scene.")
      .def(
          "__copy__", [](const Insertion& i) { return Insertion(i); }, "One that goes on to the same bits.")
      .def(
          "__deepcopy__", [](const Insertion& i, const nb::dict&) { return Insertion(i); }, nb::arg("memo"),
          nb::sig("def __deepcopy__(self, memo: dict[int, typing.Any]) -> Insertion"))
      .def("reset", &Insertion::reset, "Forgets all motion.")
      .def(
          "step",
          [](Insertion& insertion, const Triple& p, const Triple& axis) {
            check_finite(p.data(), 3, "p");
            return plain(insertion.step(vector(p), insertion.uses_axis() ? direction(axis) : Vector3d()));
          },
          nb::arg("p"), nb::arg("axis"),
          "One tick: measured position (m) and direction of the needle give the force on the device (N).")
      .def("run", &run, nb::arg("p"), nb::arg("axis"),
           nb::sig("def run(self, p: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike) -> InsertionTrace"),
           "Many ticks, from the present state on: p (n, 3), m; axis (n, 3) or (3,), directions of any length but 0.")
      .def_prop_ro(
          "tip", [](const Insertion& i) { return plain(i.tip()); }, "The conditioned position, m")
      .def_prop_ro("force", [](const Insertion& i) { return plain(i.force()); }, "N");
}

}  // namespace punctura::bindings
