// From a scene to what runs: the one place in core that throws.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "punctura/proxy/insertion.hpp"
#include "punctura/scene/check.hpp"
#include "punctura/servo/servo_step.hpp"

namespace punctura {

/// A scene that cannot be built, with all of its problems.
class SceneError : public std::invalid_argument {
 public:
  explicit SceneError(std::vector<Problem> problems)
      : std::invalid_argument(text(problems)), problems_(std::move(problems)) {}
  const std::vector<Problem>& problems() const noexcept { return problems_; }

 private:
  static std::string text(const std::vector<Problem>& problems) {
    std::string all = "the scene cannot be built";
    for (const Problem& p : problems) all += "\n  " + p.path + " = " + std::to_string(p.value) + ": " + p.reason;
    return all;
  }
  std::vector<Problem> problems_;
};

/// The model of a scene without device and safety, with a law for each membrane from `law_of(needle, membrane, i)`: both in
/// Scalar, and the membrane's number in the scene. Throws SceneError.
template <typename Scalar, typename LawOf>
auto build_insertion(const Scene& scene, LawOf&& law_of) {
  if (auto problems = check(scene); !problems.empty()) throw SceneError(std::move(problems));

  using L = std::remove_cvref_t<decltype(law_of(BasicNeedle<Scalar>{}, BasicMembrane<Scalar>{}, std::size_t{}))>;
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const BasicNeedle<Scalar> needle{to(scene.needle.diameter), to(scene.needle.tip_angle)};
  std::vector<SiteOf<L>> sites;
  for (const PlacedMembrane& placed : scene.membranes) {
    const Membrane& m = placed.membrane;
    const BasicMembrane<Scalar> membrane{to(m.stiffness), to(m.precompression), to(m.friction), to(m.thickness)};
    const Vector3d normal = vector(placed.inward_normal).stableNormalized();
    sites.push_back({law_of(needle, membrane, sites.size()), vector(placed.point).template cast<Scalar>(),
                     normal.template cast<Scalar>()});
  }
  const Scalar period = to(1 / scene.servo.rate);
  const SampledCoupling<Scalar> coupling({to(scene.coupling.stiffness), to(scene.coupling.damping)}, period);
  return InsertionOf<L>(sites, coupling, period, scene.servo.solver, to(scene.servo.low_pass), scene.direction,
                        scene.servo.conditioning, to(scene.servo.encoder_step));
}

/// The same with K06's law. Scalar: double, or float.
template <typename Scalar = double>
BasicInsertion<Scalar> build_insertion(const Scene& scene) {
  return build_insertion<Scalar>(scene, [](const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane,
                                           std::size_t) { return BasicThickLaw<Scalar>(needle, membrane); });
}

/// The whole tick of a scene: input gate, model, force limits. Throws SceneError, for scene and limits together.
inline ServoStep build(const Scene& scene, const GateLimits& gate = {}, const ForceLimits& limits = {}) {
  auto problems = check(scene);
  for (Problem& problem : check(gate, limits)) problems.push_back(std::move(problem));
  if (!problems.empty()) throw SceneError(std::move(problems));
  return ServoStep(build_insertion<double>(scene), 1 / scene.servo.rate, gate, limits);
}

}  // namespace punctura
