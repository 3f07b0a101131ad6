// core/punctura/proxy/insertion: the whole model of a scene, from positions to forces.
#include "punctura/insertion/insertion.hpp"

#include "bindings.hpp"
#include "insertion_trace.hpp"
#include "punctura/scene/build.hpp"
#include "state.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

/// An insertion that knows its scene.
struct SceneInsertion : Insertion, OneThread {
  explicit SceneInsertion(Scene given) : Insertion(build_insertion(given)), scene(std::move(given)) {}
  Scene scene;

  std::vector<std::byte> save() const { return save_state<Insertion>(*this); }
  bool load(std::span<const std::byte> state) { return load_state<Insertion>(*this, state); }
  nb::tuple arguments() const { return nb::make_tuple(scene); }
};

std::array<double, 3> step(Insertion& insertion, const Point& p, const Point& axis) {
  check_places(p.numbers.data(), 3, "p");
  return plain(insertion.step(p.vector(), insertion.uses_axis() ? direction(axis.numbers) : Vector3d()));
}

InsertionTrace run(SceneInsertion& insertion, const nb::object& positions, const nb::object& axis) {
  const Input p = points(positions, "p");
  const std::size_t n = p.shape(0);
  const Rows axes(input(axis), n, "axis");
  check_places(p.data(), 3 * n, "p", 3);
  if (insertion.uses_axis()) axes.check("axis");
  MembraneColumns columns(n, insertion.proxies().size());
  std::vector<double> force(3 * n);
  const OneThread::Running running(insertion);
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

  auto insertion = nb::class_<SceneInsertion>(
      m, "Insertion", nb::is_final(),
      "A needle through all membranes of a scene: position conditioning, one proxy a membrane, their sum. K06 (41), Fig. 8\n\n"
      "The model's own force: no safety limits.");
  def_state(insertion);
  insertion
      .def(
          "__init__",
          [](SceneInsertion* self, const Scene& scene) {
            raise_if(check(scene));
            new (self) SceneInsertion(scene);
          },
          nb::arg("scene"), "Raises ConfigurationError with all problems of the scene.")
      .def_ro("scene", &SceneInsertion::scene)
      .def(
          "reset",
          [](SceneInsertion& self) {
            self.must_rest();
            self.reset();
          },
          "Forgets all motion.")
      .def(
          "step",
          [](SceneInsertion& self, const Point& p, const Point& axis) {
            self.must_rest();
            return step(self, p, axis);
          },
          nb::arg("p"), nb::arg("axis"),
          "One tick: measured position (m) and direction of the needle give the force on the device (N).")
      .def(
          "peek",
          [](const SceneInsertion& self, const Point& p, const Point& axis) {
            self.must_rest();
            Insertion copy = self;
            return step(copy, p, axis);
          },
          nb::arg("p"), nb::arg("axis"), "What step(p, axis) would give, without that tick.")
      .def("run", &run, nb::arg("p"), nb::arg("axis"),
           nb::sig("def run(self, p: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike) -> InsertionTrace"),
           "Many ticks, from the present state on: p (n, 3), m; axis (n, 3) or (3,), directions of any length but 0.")
      .def_prop_ro(
          "tip", [](const SceneInsertion& i) { return plain(i.tip()); }, "The conditioned position, m")
      .def_prop_ro("force", [](const SceneInsertion& i) { return plain(i.force()); }, "N");
}

}  // namespace punctura::bindings
