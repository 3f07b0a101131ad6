// Builds an insertion or a servo step from a scene. try_build() returns the problems of the scene. build() throws them.
#pragma once

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "punctura/scene/check.hpp"
#include "punctura/scene/model.hpp"
#include "punctura/servo/force_scale.hpp"
#include "punctura/servo/servo_step.hpp"

namespace punctura {

namespace detail {
/// The syringe of a scene that has passed check(), and the membranes from the front to the back, as seen along the
/// first one's inward normal.
template <typename Step>
void put_syringe(const Scene& scene, Step& step) {
  using Scalar = typename Step::Scalar;
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const auto outlet = [&](const Outlet& o) { return BasicOutlet<Scalar>{to(o.resistance), to(o.pressure)}; };
  const Vector3d inward = to_vector(scene.membranes[0].inward_normal);
  const auto place = [&](std::uint32_t i) { return inward.dot(to_vector(scene.membranes[i].point)); };
  std::vector<LayerOutlets<Scalar>> layers;
  for (std::uint32_t i = 0; i < scene.membranes.size(); ++i) {
    const PlacedMembrane& m = scene.membranes[i];
    layers.push_back({i, to(m.membrane.thickness), outlet(m.outflow), outlet(m.outflow_behind)});
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [&](const auto& a, const auto& b) { return place(a.membrane) < place(b.membrane); });
  const auto& [s, thumb] = *scene.syringe;
  const BasicSyringe<Scalar> syringe{to(s.bore),     to(s.liquid),     to(s.air),
                                     to(s.friction), to(s.compliance), to(s.resistance)};
  const BasicCoupling<Scalar> coupling{to(thumb.stiffness), to(thumb.damping)};
  const BasicPlunger<Scalar> plunger(syringe, coupling, to(1 / scene.servo.rate));
  step.set_syringe({plunger, to(tip_length(scene.needle)), layers});
}

/// The result of make(); empty if there are problems `found`, which are added to `problems`.
template <typename Make>
auto if_good(const std::vector<Problem>& found, std::vector<Problem>& problems, Make&& make) {
  problems.insert(problems.end(), found.begin(), found.end());
  return found.empty() ? std::make_optional(make()) : std::nullopt;
}

/// Adds a problem for each law of a model that has a flaw, and for a coupling that pulls. The model is then empty.
template <typename Model>
void check_model(std::optional<Model>& model, std::vector<Problem>& problems) {
  if constexpr (requires { untouched_pieces(model->proxies()[0].params().law, 1); }) {
    const std::size_t before = problems.size();
    for (std::size_t i = 0; model && i < model->size(); ++i) {
      const auto& proxy = model->proxies()[i].params();
      const std::string wall = "membrane[" + std::to_string(i) + "]";
      check_law(untouched_pieces(proxy.law, 1), wall, problems);
      if (!is_unit(proxy.n))
        problems.push_back({wall + ".inward_normal", static_cast<double>(proxy.n.norm()), "must have the length 1"});
      if (const auto g = static_cast<double>(proxy.coupling.g); i == 0 && !(g > 0 && std::isfinite(g)))
        problems.push_back({"coupling.g", g, "must be a number greater than 0 N/m: a weaker spring pulls the needle"});
    }
    if (problems.size() > before) model.reset();
  }
}
}  // namespace detail

/// A function that returns the law of membrane i: `law_of(needle, membrane, i)`.
template <typename LawOf, typename Scalar>
concept GivesLaws = std::invocable<LawOf, const BasicNeedle<Scalar>&, const BasicMembrane<Scalar>&, std::size_t>;

/// Builds the model of a scene, without device and safety limits. Scalar: double or float.
///
/// law_of(needle, membrane, i) returns the law of each membrane, in place of the scene's. needle and membrane are in
/// Scalar. i is the number of the membrane in the scene. The coupling is K06's. The result is empty if the scene has
/// problems, or a law has a flaw (find_flaw()). They are added to `problems`.
template <typename Scalar, GivesLaws<Scalar> LawOf>
auto try_build_insertion(const Scene& scene, std::vector<Problem>& problems, LawOf&& law_of) {
  auto found = check(scene);
  if (!scene.relaxation.empty())
    found.push_back({"coupling.relaxation", static_cast<double>(scene.relaxation.size()),
                     "with laws of your own, build an InsertionOf with a RelaxingCoupling yourself"});
  auto made = detail::if_good(
      found, problems, [&] { return detail::insertion_of<Scalar>(scene, detail::coupling_of<Scalar>(scene), law_of); });
  detail::check_model(made, problems);
  return made;
}
/// Builds the model of a scene with the laws of its membranes.
template <typename Scalar = double>
std::optional<BasicInsertion<Scalar>> try_build_insertion(const Scene& scene, std::vector<Problem>& problems) {
  return detail::if_good(check(scene), problems, [&] { return detail::model_of<Scalar>(scene); });
}

/// The largest force of a model of any kind along the needle, N. insertion: of the scene, which has passed check().
///
/// A model without bands is tried: from 5 mm in front of the first membrane to 30 mm behind the last one.
template <typename Insertion>
double largest_force(const Scene& scene, const Insertion& insertion) {
  if constexpr (requires { largest_force(insertion); }) {
    return largest_force(insertion);
  } else {
    const Vector3d first = to_vector(scene.membranes[0].point),
                   inwards = to_vector(scene.membranes[0].inward_normal).stableNormalized();
    double farthest = 0;
    for (const PlacedMembrane& m : scene.membranes)
      farthest = std::max(farthest, inwards.dot(to_vector(m.point) - first));
    return largest_force(insertion, first - 5e-3 * inwards, inwards, farthest + 35e-3, 1 / scene.servo.rate);
  }
}

/// How much of the model's force a device with these limits gives. insertion: as in largest_force().
template <typename Insertion>
double force_scale(const Scene& scene, const Insertion& insertion, const ForceLimits& limits) {
  return scene.display.automatic ? automatic_force_scale(largest_force(scene, insertion), limits)
                                 : scene.display.force_scale;
}

namespace detail {
/// The servo step of a scene that has passed check(), with its insertion. Empty if the limits have problems.
template <typename Insertion>
std::optional<ServoStepOf<Insertion>> step_of(const Scene& scene, std::optional<Insertion> insertion,
                                              std::vector<Problem>& problems, const GateLimits& gate,
                                              const ForceLimits& limits) {
  using Scalar = typename Insertion::Scalar;
  const auto found = check(gate, limits);
  problems.insert(problems.end(), found.begin(), found.end());
  if (!insertion || !found.empty()) return std::nullopt;
  const auto scale = std::max(static_cast<Scalar>(force_scale(scene, *insertion, limits)),
                              std::numeric_limits<Scalar>::min());  // a scale that is too small for a float
  auto made = std::make_optional<ServoStepOf<Insertion>>(
      std::move(*insertion), static_cast<Scalar>(1 / scene.servo.rate), gate, limits, scale);
  if (scene.syringe) put_syringe(scene, *made);
  return made;
}
}  // namespace detail

/// The whole tick of a scene: input gate, model, force scale, force limits. Laws as in try_build_insertion(). Empty
/// where scene or limits have problems, which are added to `problems`.
template <typename Scalar, GivesLaws<Scalar> LawOf>
auto try_build(const Scene& scene, std::vector<Problem>& problems, LawOf&& law_of, const GateLimits& gate = {},
               const ForceLimits& limits = {}) {
  return detail::step_of(scene, try_build_insertion<Scalar>(scene, problems, law_of), problems, gate, limits);
}
/// Builds the servo step of a scene with the laws of its membranes.
template <typename Scalar = double>
std::optional<BasicServoStep<Scalar>> try_build(const Scene& scene, std::vector<Problem>& problems,
                                                const GateLimits& gate = {}, const ForceLimits& limits = {}) {
  return detail::step_of(scene, try_build_insertion<Scalar>(scene, problems), problems, gate, limits);
}

#if defined(__cpp_exceptions)
/// A scene cannot be built. problems() are all of its problems.
class SceneError : public std::invalid_argument {
 public:
  explicit SceneError(std::vector<Problem> problems)
      : std::invalid_argument(text(problems)), problems_(std::move(problems)) {}
  const std::vector<Problem>& problems() const noexcept { return problems_; }

 private:
  static std::string text(const std::vector<Problem>& problems) {
    std::string all = "the scene cannot be built";
    for (const Problem& p : problems) all += "\n  " + line_of(p);
    return all;
  }
  std::vector<Problem> problems_;
};

namespace detail {
/// The result of make(problems). Throws SceneError if it is empty.
template <typename Make>
auto or_throw(Make&& make) {
  std::vector<Problem> problems;
  auto made = make(problems);
  if (!made) throw SceneError(std::move(problems));
  return std::move(*made);
}
}  // namespace detail

/// The same as try_build_insertion(), but throws SceneError.
template <typename Scalar, GivesLaws<Scalar> LawOf>
auto build_insertion(const Scene& scene, LawOf&& law_of) {
  return detail::or_throw([&](auto& problems) { return try_build_insertion<Scalar>(scene, problems, law_of); });
}
template <typename Scalar = double>
BasicInsertion<Scalar> build_insertion(const Scene& scene) {
  return detail::or_throw([&](auto& problems) { return try_build_insertion<Scalar>(scene, problems); });
}

/// The same as try_build(), but throws SceneError with the problems of scene and limits.
template <typename Scalar, GivesLaws<Scalar> LawOf>
auto build(const Scene& scene, LawOf&& law_of, const GateLimits& gate = {}, const ForceLimits& limits = {}) {
  return detail::or_throw([&](auto& problems) { return try_build<Scalar>(scene, problems, law_of, gate, limits); });
}
template <typename Scalar = double>
BasicServoStep<Scalar> build(const Scene& scene, const GateLimits& gate = {}, const ForceLimits& limits = {}) {
  return detail::or_throw([&](auto& problems) { return try_build<Scalar>(scene, problems, gate, limits); });
}
#endif

}  // namespace punctura
