// core/punctura/insertion: the complete model of a scene, from position to force.
#include "punctura/insertion/insertion.hpp"

#include "bindings.hpp"
#include "punctura/scene/build.hpp"
#include "run_in_space.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

/// An insertion that keeps its scene.
struct SceneInsertion : Insertion, OneThread {
  explicit SceneInsertion(Scene given) : Insertion(build_insertion(given)), scene(std::move(given)) {}
  Scene scene;

  nb::tuple arguments() const { return nb::make_tuple(scene); }
};

template <typename Get>
auto of_membranes(const SceneInsertion& insertion, Get get) {
  std::vector<decltype(get(insertion.tick(0)))> values;
  for (std::size_t i = 0; i < insertion.size(); ++i) values.push_back(get(insertion.tick(i)));
  return shown_tuple(values);
}

}  // namespace

void bind_insertion(nb::module_& m) {
  auto insertion = nb::class_<SceneInsertion>(
      m, "Insertion", nb::is_final(),
      "A needle through all membranes of a scene: position conditioning and the sum of one proxy per membrane. K06\n"
      "(41), Fig. 8\n\n"
      "Gives the model's force without safety limits.");
  def_state(insertion);
  def_reset(insertion);
  def_repr(insertion, "<Insertion in {0.scene.name!r}: tip {0.tip} m, force {0.force} N>");
  insertion.def(nb::init<Scene>(), nb::arg("scene"), "Raises ConfigurationError with all problems of the scene.");
  def_steps_in_space<Insertion>(insertion);
  insertion.def_ro("scene", &SceneInsertion::scene);
  def_run_in_space(
      insertion,
      {"position", "axis", "tip", "force", "depth", "axial_force", "lower", "upper", "proxy", "direction", "phase"},
      "Makes n ticks from the present state on.\n\n"
      "p (n, 3): positions, m. axis (n, 3) or (3,): directions of any length but 0. Raises ValueError.\n"
      "progress: a function of the finished share, 0 to 1, or True for a bar. After Ctrl-C some\n"
      "ticks were made and are lost; `state` goes back to an earlier tick.");
  const Getters get{insertion};
  get("depths", "Depth of the proxy behind each membrane, last tick, m",
      [](auto& i) { return of_membranes(i, [](const auto& tick) { return tick.depth; }); });
  get("phases", "Phase at each membrane in the last tick",
      [](auto& i) { return of_membranes(i, [](const auto& tick) { return tick.phase; }); });
  get("tip", "The conditioned position, m", [](auto& i) { return to_array(i.tip()); });
  get("force", "The force of the last tick, N", [](auto& i) { return to_array(i.force()); });
}

}  // namespace punctura::bindings
