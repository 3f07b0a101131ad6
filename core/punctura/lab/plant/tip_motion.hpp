// The motion of the mass that device and hand form at the tip. Scalar: a number, or lanes (model/lane.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "punctura/lab/plant/hand.hpp"

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

/// The position and velocity of the tip: m v' = f_device + k (x_d - x) + b (v_d - v) + dry friction, with m = device
/// + hand.
///
/// The force of the device is constant over a step, as with a digital-to-analogue converter, and the desired motion is
/// a straight line. So mass, spring and damper have a closed form. Dry friction is a constant force against the mean
/// velocity of the step, which is exact on a straight way. Where the tip stops within a step, the step has two parts.
/// A tip that rests while friction can hold it keeps its position to the last bit.
///
/// docs/plant.md has the error.
template <typename Scalar>
struct BasicTipMotion {
  using Vector = Vector3<Scalar>;

  Vector x{}, v{};  ///< m, m/s

  /// One step. force: of the device, N. wanted: the desired position at the begin of the step, m. toward: the desired
  /// velocity, m/s.
  void step(const BasicTipResponse<Scalar>& r, const Vector& force, const Vector& wanted,
            const Vector& toward) noexcept {
    using namespace lane;
    const Vector pull = force + r.stiffness * (wanted - x), relative = v - toward;
    const Vector free_v = toward + r.kept * relative + r.velocity * pull;
    const Vector both = v + free_v;  // along the mean velocity, also with friction
    const Scalar size = both.norm(), lost = r.velocity * r.friction;
    const auto moves = size > lost, rests = v.squaredNorm() == 0;
    if (all(rests && !moves)) {
      v = {};
      return;
    }
    const Vector free_x = x + r.time * toward + r.travel * relative + r.way * pull;
    const Vector drag = select(moves, Scalar(r.friction / size), Scalar(0)) * both;
    const Vector end_v = free_v - r.velocity * drag;
    const auto stops = !rests && lost > 0 && !(moves && v.dot(end_v) > 0);
    const Part whole{select(moves || !rests, Vector(free_x - r.way * drag), x),
                     select(moves || !rests, end_v, Vector())};
    if (any(stops)) {
      const Part parts = with_stop(r, force, wanted, toward, free_v);
      x = select(stops, parts.x, whole.x);
      v = select(stops, parts.v, whole.v);
    } else {
      x = whole.x;
      v = whole.v;
    }
  }

 private:
  struct Part {
    Vector x, v;
  };

  /// A step in which friction stops the motion along v. Then the tip rests, or goes where the pull is stronger than
  /// friction. The velocity is a straight line in both parts. free_v: at the end, without friction, m/s.
  Part with_stop(const BasicTipResponse<Scalar>& r, const Vector& force, const Vector& wanted, const Vector& toward,
                 const Vector& free_v) const noexcept {
    using namespace lane;
    const Scalar speed = v.norm(), lost = r.velocity * r.friction;
    const Vector along = v / speed, full = free_v - lost * along;
    const Scalar end = full.dot(along);                // not above 0
    const Scalar share = speed / (speed - end);        // of the step, until the stop
    const Vector side = share * (full - end * along);  // the rest of the velocity then
    const Vector stop = x + Scalar(share * r.time / 2) * (v + side);
    const Scalar left = 1 - share, later = (1 + share) * r.time / 2;
    const Vector pull = force + r.stiffness * (wanted + later * toward - stop) + r.damping * (toward - side);
    const Vector next = side + Scalar(left * r.velocity) * pull;
    const Scalar size = next.norm(), braked = left * lost;
    const Vector end_v = select(size > braked, Scalar(1 - braked / size), Scalar(0)) * next;
    return {stop + Scalar(left * r.time / 2) * (side + end_v), end_v};
  }
};

/// The position that encoders report for x, m: a multiple of encoder_step plus an offset. phase: the offset, in steps.
template <typename Scalar>
Vector3<Scalar> encoded(const Vector3<Scalar>& x, const Scalar& encoder_step, const Vector3<Scalar>& phase) noexcept {
  using namespace lane;
  Vector3<Scalar> counts = x / encoder_step + phase;
  for (Scalar& count : counts) count = floor(count + Lane<Scalar>(0.5));
  return select(encoder_step == 0, x, Vector3<Scalar>((counts - phase) * encoder_step));
}

}  // namespace punctura
