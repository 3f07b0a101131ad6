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

/// The model of a scene without device and safety. Scalar: double, or float. Throws SceneError.
template <typename Scalar = double>
BasicInsertion<Scalar> build_insertion(const Scene& scene) {
  if (auto problems = check(scene); !problems.empty()) throw SceneError(std::move(problems));

  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const BasicNeedle<Scalar> needle{to(scene.needle.diameter), to(scene.needle.tip_angle)};
  std::vector<MembraneSite<Scalar>> sites;
  for (const PlacedMembrane& placed : scene.membranes) {
    const Membrane& m = placed.membrane;
    const BasicMembrane<Scalar> membrane{to(m.stiffness), to(m.precompression), to(m.friction), to(m.thickness)};
    const Vector3d normal = vector(placed.inward_normal).stableNormalized();
    sites.push_back({BasicThickLaw<Scalar>(needle, membrane), vector(placed.point).template cast<Scalar>(),
                     normal.template cast<Scalar>()});
  }
  return BasicInsertion<Scalar>(sites, {to(scene.coupling.stiffness), to(scene.coupling.damping)},
                                to(1 / scene.servo.rate), scene.servo.solver, to(scene.servo.low_pass), scene.direction,
                                scene.servo.conditioning, to(scene.servo.encoder_step));
}

/// The whole tick of a scene: input gate, model, force limits. Throws SceneError, for scene and limits together.
inline ServoStep build(const Scene& scene, const GateLimits& gate = {}, const ForceLimits& limits = {}) {
  auto problems = check(scene);
  for (Problem& problem : check(gate, limits)) problems.push_back(std::move(problem));
  if (!problems.empty()) throw SceneError(std::move(problems));
  return ServoStep(build_insertion<double>(scene), 1 / scene.servo.rate, gate, limits);
}

}  // namespace punctura
