// A needle through several layers, each with a rival: the same interface as InsertionOf, so a servo step can run it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "punctura/insertion/conditioned_proxies.hpp"
#include "punctura/rivals/rival_proxy.hpp"
#include "punctura/scene/build.hpp"

namespace punctura {

/// The force of rivals at the places of a scene's membranes. Conditioning and sub-steps are those of K06.
///
/// `ServoStepOf<RivalInsertion>` is a whole tick: the same gate and the same force limits as for K06.
class RivalInsertion : public ConditionedProxies<RivalProxy, HeapStorage> {
 public:
  /// rivals: one for each membrane of a scene that has passed check().
  RivalInsertion(const Scene& scene, std::span<const AnyRival> rivals)
      : ConditionedProxies(1 / scene.servo.rate, scene.servo.low_pass, scene.direction, scene.servo.conditioning,
                           scene.servo.encoder_step, static_cast<std::uint32_t>(scene.servo.sub_steps)) {
    const double period = 1 / scene.servo.rate / scene.servo.sub_steps;
    for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
      const PlacedMembrane& at = scene.membranes[i];
      proxies_.emplace_back(rivals[i], to_vector(at.point), to_vector(at.inward_normal).stableNormalized(), period);
    }
    reset();
  }
};

/// The servo step with rivals.
using RivalServoStep = ServoStepOf<RivalInsertion>;

/// The whole tick of a scene with rivals in place of K06's law: the same input gate, force limits and force scale as
/// the scene has with K06. rivals: one for each membrane. The scene has passed check().
inline RivalServoStep build_rivals(const Scene& scene, std::span<const AnyRival> rivals, const GateLimits& gate = {},
                                   const ForceLimits& limits = {}) {
  double scale = scene.display.force_scale;
  if (scene.display.automatic) {  // from the largest force of K06
    std::vector<Problem> problems;
    scale = force_scale(scene, *try_build_insertion(scene, problems), limits);
  }
  RivalServoStep step(RivalInsertion(scene, rivals), 1 / scene.servo.rate, gate, limits, scale);
  if (scene.syringe) detail::put_syringe(scene, step);
  return step;
}

}  // namespace punctura
