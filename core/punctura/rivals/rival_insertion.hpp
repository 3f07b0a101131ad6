// A needle through several layers, each with a rival: the same interface as InsertionOf, so a servo step can run it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "punctura/insertion/match_by_place.hpp"
#include "punctura/rivals/rival_proxy.hpp"
#include "punctura/scene/build.hpp"

namespace punctura {

/// The force of rivals at the places of a scene's membranes. Conditioning and sub-steps are those of K06.
///
/// `ServoStepOf<RivalInsertion>` is a whole tick: the same gate and the same force limits as for K06.
class RivalInsertion {
 public:
  using Scalar = double;
  using Vector = Vector3d;
  using StoredIn = HeapStorage;
  using Proxies = std::vector<RivalProxy>;

  /// rivals: one for each membrane of a scene that has passed check().
  RivalInsertion(const Scene& scene, std::span<const AnyRival> rivals)
      : conditioner_(scene.servo.conditioning, scene.servo.low_pass, scene.servo.encoder_step, 1 / scene.servo.rate),
        sub_steps_(static_cast<std::uint32_t>(scene.servo.sub_steps)) {
    if (scene.direction == Direction::motion) from_motion_.emplace(1 / scene.servo.rate);
    const double period = 1 / scene.servo.rate / scene.servo.sub_steps;
    for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
      const PlacedMembrane& at = scene.membranes[i];
      proxies_.emplace_back(rivals[i], to_vector(at.point), to_vector(at.inward_normal).stableNormalized(), period);
    }
    reset();
  }

  void reset() noexcept {
    conditioner_.reset();
    if (from_motion_) from_motion_->reset();
    for (RivalProxy& proxy : proxies_) proxy.reset();
    tip_.setZero();
    force_.setZero();
  }
  void resume(RivalInsertion& previous) noexcept {
    conditioner_.resume(previous.conditioner_);
    if (from_motion_ && previous.from_motion_) from_motion_->resume(*previous.from_motion_);
    tip_ = previous.tip_;
    match_by_place(proxies_, previous.proxies_, [](RivalProxy& proxy, const RivalProxy& old) { proxy.resume(old); });
  }

  /// As InsertionOf::step().
  Vector step(const Vector& position, const Vector& axis) noexcept {
    if (!is_place(position) || (uses_axis() && !axis.allFinite()))
      return Vector::Constant(std::numeric_limits<double>::quiet_NaN());
    const bool first = !conditioner_.started();
    const Vector before = tip_;
    tip_ = conditioner_.step(position);
    const Vector direction = from_motion_ ? from_motion_->step(tip_) : axis;
    if (sub_steps_ > 1 && !first) step_between(before, direction);
    force_.setZero();
    for (RivalProxy& proxy : proxies_) force_ += proxy.step_finite(tip_, direction);
    return force_;
  }

  static void archive(auto& self, auto& state) {
    PositionConditioner<double>::archive(self.conditioner_, state);
    if (self.from_motion_) EntryDirection<double>::archive(*self.from_motion_, state);
    for (auto& proxy : self.proxies_) RivalProxy::archive(proxy, state);
    state.numbers(self.tip_, self.force_);
  }
  void describe(auto& parameters) const {
    conditioner_.describe(parameters);
    parameters.flag(uses_axis());
    if (from_motion_) from_motion_->describe(parameters);
    parameters.index(sub_steps_, 0);
    for (const RivalProxy& proxy : proxies_) proxy.describe(parameters);
  }

  const Vector& tip() const noexcept { return tip_; }
  const Vector& force() const noexcept { return force_; }
  bool uses_axis() const noexcept { return !from_motion_; }
  const Proxies& proxies() const noexcept { return proxies_; }
  std::size_t size() const noexcept { return proxies_.size(); }
  const SpaceTick<double>& tick(std::size_t i) const noexcept { return proxies_[i].tick(); }
  double cos_beta(std::size_t i) const noexcept { return proxies_[i].state().cos_beta; }
  bool outside() const noexcept {
    for (const RivalProxy& proxy : proxies_)
      if (proxy.phase() != Phase::outside) return false;
    return true;
  }

 private:
  /// The sub-steps of a tick without the last one. before: the conditioned position of the last tick, m.
  void step_between(const Vector& before, const Vector& direction) noexcept {
    for (std::uint32_t i = 1; i < sub_steps_; ++i) {
      const Vector between = before + (static_cast<double>(i) / sub_steps_) * (tip_ - before);
      for (RivalProxy& proxy : proxies_) proxy.step_finite(between, direction);
    }
  }

  PositionConditioner<double> conditioner_;
  std::optional<EntryDirection<double>> from_motion_;
  std::uint32_t sub_steps_;
  Proxies proxies_;
  Vector tip_ = Vector::Zero(), force_ = Vector::Zero();
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
