// The simulated plant: a haptic device in a hand.
#pragma once

#include <cstdint>
#include <limits>

#include "punctura/lab/plant/hand.hpp"
#include "punctura/lab/plant/noise.hpp"
#include "punctura/lab/plant/tip_motion.hpp"

namespace punctura {

/// The numbers of a seed: the offset of the encoders, in steps, and the noise of the tremor in tick k.
inline Vector3d encoder_phase(const TickNoise& seed) noexcept { return seed.at(0); }
inline Vector3d tremor_noise(const TickNoise& seed, std::uint64_t k) noexcept { return seed.at(k + 1); }

/// A haptic device in a hand, at its tip: BasicTipMotion with the noise of a seed.
template <typename Scalar>
class BasicPlant {
 public:
  using Vector = Vector3<Scalar>;

  BasicPlant(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand, Scalar period,
             std::uint64_t seed = 0) noexcept
      : device_(device),
        hand_(hand),
        seed_(seed),
        steps_(tip_steps(device, hand, period)),
        response_(tip_response(device, hand, static_cast<double>(period) / steps_).of_each([](double number) {
          return static_cast<Scalar>(number);
        })),
        tremor_(hand, period),
        phase_(encoder_phase(seed).template cast<Scalar>()) {}

  /// Sets the position of the tip, m, at rest.
  void place(const Vector& position) noexcept { tip_ = {position, Vector::Zero()}; }

  /// One servo period. force: constant force of the device, N. desired: the desired motion of the hand.
  void step(const Vector& force, const BasicDesired<Scalar>& desired) noexcept {
    const Vector noise = tremor_.is_off() ? Vector() : tremor_noise(seed_, tick_).template cast<Scalar>();
    const Vector held = device_.saturate(force), wanted = desired.position + tremor_.step(noise);
    for (std::uint32_t i = 0; i < steps_; ++i)
      tip_.step(response_, held, wanted + (static_cast<Scalar>(i) * response_.time) * desired.velocity,
                desired.velocity);
    ++tick_;
  }

  const Vector& tip() const noexcept { return tip_.x; }       ///< true position of the tip, m
  const Vector& velocity() const noexcept { return tip_.v; }  ///< m/s

  /// The position that the encoders report, m: a multiple of encoder_step plus an offset that depends on the seed.
  Vector measured() const noexcept { return encoded(tip_.x, device_.encoder_step, phase_); }

  /// For save_state() and load_state() (state/archive.hpp).
  static void archive(auto& self, auto& state) { state.fields(self.tick_, self.tremor_, self.tip_.x, self.tip_.v); }
  void describe(auto& parameters) const {
    device_.describe(parameters);
    hand_.describe(parameters);
    parameters.index(seed_, 0);
    parameters.fields(response_.time);
  }

 private:
  BasicDeviceDynamics<Scalar> device_;
  BasicHand<Scalar> hand_;
  std::uint64_t seed_, tick_ = 0;
  std::uint32_t steps_;
  BasicTipResponse<Scalar> response_;
  BasicTremor<Scalar> tremor_;
  Vector phase_;
  BasicTipMotion<Scalar> tip_{};
};

using Plant = BasicPlant<double>;
using PlantF = BasicPlant<float>;

}  // namespace punctura
