// The motion of the mass that device and hand form at the tip. Scalar: a number, or lanes (model/lane.hpp).
#pragma once

#include "punctura/lab/plant/tip_response.hpp"

namespace punctura {

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
