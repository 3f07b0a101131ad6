// How the mass of device and hand at the tip answers a force that is constant over a step, without dry friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "punctura/lab/plant/device_dynamics.hpp"
#include "punctura/lab/plant/hand_dynamics.hpp"

namespace punctura {
namespace detail {

/// y and y' at `time`, with y'' + damped y' + sprung y = 1, from rest at 0. The power series of a short time is doubled
/// until it has the whole length. So one formula serves every damping, and neither may be 0 nor near a limit.
struct UnitResponse {
  double way, velocity;

  constexpr UnitResponse(double sprung, double damped, double time) noexcept : way(0), velocity(0) {
    int doublings = 0;
    for (; doublings < 2000 && std::max(damped * time, sprung * time * time) > 0.01; ++doublings) time /= 2;
    double before = 0, term = time;  // of y': term j = c(j) time^j / j!, c(j + 1) = -damped c(j) - sprung c(j - 1)
    for (int j = 1; j <= 8; ++j) {
      velocity += term;
      way += term * time / (j + 1);
      const double next = -(damped * time / (j + 1)) * term - sprung * time * time / (j * (j + 1)) * before;
      before = term;
      term = next;
    }
    for (; doublings > 0; --doublings) {
      const double once = way;
      way = once * (2 - sprung * once) + velocity * velocity;
      velocity *= 2 - 2 * sprung * once - damped * velocity;
    }
  }
};

}  // namespace detail

/// The motion of m = device + hand in a step, as numbers of that step: spring and damper of the hand are solved
/// exactly, so that a tick needs no exponential. Lanes take the numbers of single trials.
template <typename Scalar>
struct BasicTipResponse {
  Scalar time{};                              ///< of a step, s
  Scalar travel{};                            ///< way for a velocity relative to the hand's, s
  Scalar kept{};                              ///< share of this velocity at the end
  Scalar way{}, velocity{};                   ///< for a force, m/N and m/(N s)
  Scalar stiffness{}, damping{}, friction{};  ///< N/m, N s/m; dry friction, N

  /// of_each(f): the same numbers as f(number), of another type.
  auto of_each(auto&& f) const noexcept {
    return BasicTipResponse<decltype(f(time))>{f(time),     f(travel),    f(kept),    f(way),
                                               f(velocity), f(stiffness), f(damping), f(friction)};
  }
};

using TipResponse = BasicTipResponse<double>;

/// The number of steps in a servo period (s), at most 1000. More than one only for a grip that is so stiff that it
/// swings, or so damped that it follows, within a period: a step with dry friction needs one direction of motion.
template <typename Scalar>
std::uint32_t tip_steps(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand,
                        double period) noexcept {
  const double mass = static_cast<double>(device.mass) + static_cast<double>(hand.mass);
  const double fastest = std::max(std::sqrt(hand.stiffness / mass), hand.damping / mass);
  return static_cast<std::uint32_t>(std::clamp(std::ceil(fastest * period / 0.5), 1.0, 1000.0));
}

/// time: s, of a step. A grip that swings within a step, although tip_steps() has cut the period, has no dry friction.
template <typename Scalar>
TipResponse tip_response(const BasicDeviceDynamics<Scalar>& device, const BasicHand<Scalar>& hand,
                         double time) noexcept {
  const double mass = static_cast<double>(device.mass) + static_cast<double>(hand.mass);
  const double sprung = hand.stiffness / mass, damped = hand.damping / mass;
  const detail::UnitResponse unit(sprung, damped, time);
  return {time,
          unit.velocity,
          1 - damped * unit.velocity - sprung * unit.way,
          unit.way / mass,
          unit.velocity / mass,
          hand.stiffness,
          hand.damping,
          sprung * time * time > 1 ? 0.0 : static_cast<double>(device.friction)};
}

}  // namespace punctura
