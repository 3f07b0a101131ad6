// A needle through several layers, each with a rival: the same interface as InsertionOf, so a servo step can run it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "punctura/insertion/conditioned_proxies.hpp"
#include "punctura/rivals/rival_proxy.hpp"
#include "punctura/scene/build.hpp"

namespace punctura {

/// The force of rivals at the places of a scene's membranes. Conditioning and sub-steps are those of K06.
///
/// `ServoStepOf<RivalInsertion>` is a whole tick: the same gate and the same force limits as for K06.
class RivalInsertion : public ConditionedProxies<double, std::vector<RivalProxy>, HeapStorage> {
 public:
  /// rivals: one for each membrane of a scene that has passed check(), or one for all.
  RivalInsertion(const Scene& scene, std::span<const AnyRival> rivals)
      : ConditionedProxies(1 / scene.servo.rate, scene.servo.low_pass, scene.direction, scene.servo.conditioning,
                           scene.servo.encoder_step, static_cast<std::uint32_t>(scene.servo.sub_steps)) {
    const double period = 1 / scene.servo.rate / scene.servo.sub_steps;
    for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
      const PlacedMembrane& at = scene.membranes[i];
      proxies_.emplace_back(rivals[rivals.size() == 1 ? 0 : i], to_vector(at.point),
                            to_vector(at.inward_normal).stableNormalized(), period);
    }
    reset();
  }
};

/// The servo step with rivals.
using RivalServoStep = ServoStepOf<RivalInsertion>;

/// The model of a scene with rivals in place of K06's law: one for each membrane, or one for all. Empty if there are
/// problems, which are added to `problems`.
inline std::optional<RivalInsertion> try_build_rivals(const Scene& scene, std::span<const AnyRival> rivals,
                                                      std::vector<Problem>& problems) {
  auto found = check(scene);
  if (rivals.size() != 1 && rivals.size() != scene.membranes.size())
    found.push_back({"rivals", static_cast<double>(rivals.size()),
                     "must be one rival, or one for each of the " + std::to_string(scene.membranes.size()) +
                         " membranes of the scene"});
  return detail::if_good(found, problems, [&] { return RivalInsertion(scene, rivals); });
}

#if defined(__cpp_exceptions)
/// The whole tick of a scene with rivals: the same input gate, force limits and syringe as the scene has with K06. An
/// automatic force scale follows from the rivals' own forces. Throws SceneError.
inline RivalServoStep build_rivals(const Scene& scene, std::span<const AnyRival> rivals, const GateLimits& gate = {},
                                   const ForceLimits& limits = {}) {
  return detail::or_throw([&](auto& problems) {
    return detail::step_of(scene, try_build_rivals(scene, rivals, problems), problems, gate, limits);
  });
}
#endif

}  // namespace punctura
