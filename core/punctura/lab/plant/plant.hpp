// The simulated plant: a haptic device in a hand.
#pragma once

#include <cstdint>

#include "punctura/lab/plant/hand.hpp"
#include "punctura/lab/plant/tip_motion.hpp"

namespace punctura {

/// A haptic device in a hand, at its tip: BasicTipMotion with the noise of a seed.
template <typename Scalar>
class BasicPlant {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr int substeps = BasicTipMotion<Scalar>::substeps;

  BasicPlant(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand, Scalar period,
             std::uint64_t seed = 0) noexcept
      : device_(device), hand_(hand), h_(period / substeps), noise_(seed), tremor_(hand, period) {
    phase_ = noise_.uniform_vector().template cast<Scalar>();
  }

  /// Sets the position of the tip, m, at rest.
  void place(const Vector& position) noexcept { tip_ = {position, Vector::Zero()}; }

  /// One servo period. force: constant force of the device, N. desired: the desired motion of the hand.
  void step(const Vector& force, const BasicDesired<Scalar>& desired) noexcept {
    tip_.step(device_, hand_, h_, force, desired, tremor_.step(noise_));
  }

  const Vector& tip() const noexcept { return tip_.x; }       ///< true position of the tip, m
  const Vector& velocity() const noexcept { return tip_.v; }  ///< m/s

  /// The position that the encoders report, m: a multiple of encoder_step plus an offset that depends on the seed.
  Vector measured() const noexcept { return encoded(tip_.x, device_.encoder_step, phase_); }

  /// For save_state() and load_state() (state/archive.hpp).
  static void archive(auto& self, auto& state) {
    Noise::archive(self.noise_, state);
    BasicTremor<Scalar>::archive(self.tremor_, state);
    state.numbers(self.tip_.x, self.tip_.v);
  }
  void describe(auto& parameters) const {
    device_.describe(parameters);
    hand_.describe(parameters);
    noise_.describe(parameters);
    parameters.numbers(h_);
  }

 private:
  BasicDeviceDynamics<Scalar> device_;
  BasicHand<Scalar> hand_;
  Scalar h_;
  Noise noise_;
  BasicTremor<Scalar> tremor_;
  Vector phase_;
  BasicTipMotion<Scalar> tip_{};
};

using Plant = BasicPlant<double>;
using PlantF = BasicPlant<float>;

}  // namespace punctura
