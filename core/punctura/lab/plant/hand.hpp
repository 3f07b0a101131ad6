// A simulated device at the tip, the hand that holds its stylus, the hand's desired motion and its tremor.
#pragma once

#include <cmath>
#include <numbers>

#include "punctura/model/omni.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// The mechanics of a device at the tip. The defaults are those of a PHANTOM Omni.
///
/// The values are constant. On a real device they change over the workspace and with the direction.
template <typename Scalar>
struct BasicDeviceDynamics {
  Scalar mass = Scalar(Omni::mass);                  ///< kg
  Scalar friction = Scalar(Omni::friction);          ///< dry friction, N
  Scalar encoder_step = Scalar(Omni::encoder_step);  ///< m; 0 is an ideal sensor
  Scalar max_force = Scalar(Omni::max_force);        ///< norm at which the motors saturate, N

  /// The force that the motors give for a commanded force, N.
  Vector3<Scalar> saturate(const Vector3<Scalar>& force) const noexcept {
    using namespace lane;
    // Nearly all forces are so far below that rounding cannot matter: they need neither root nor division.
    if (all(force.squaredNorm() < Lane<Scalar>(0.999) * max_force * max_force)) return force;
    const Scalar norm = force.norm();
    return select(norm > max_force, Vector3<Scalar>(force * (max_force / norm)), force);
  }

  void describe(auto& parameters) const { parameters.fields(mass, friction, encoder_step, max_force); }
};

using DeviceDynamics = BasicDeviceDynamics<double>;
using DeviceDynamicsF = BasicDeviceDynamics<float>;

/// The desired motion of the tip.
template <typename Scalar>
struct BasicDesired {
  Vector3<Scalar> position;  ///< m
  Vector3<Scalar> velocity;  ///< m/s

  template <typename Other>
  BasicDesired<Other> cast() const noexcept {
    return {position.template cast<Other>(), velocity.template cast<Other>()};
  }
};
using Desired = BasicDesired<double>;

/// A hand: a mass with a spring and a damper to the desired motion.
///
/// The second-order form and the order of magnitude are those of measured pen-hold and pinch grasps (Hasser and
/// Cutkosky 2002; Fu and Cavusoglu 2012). The numbers are illustrative: stiffness and damping change several-fold
/// with the grip force and between persons.
template <typename Scalar>
struct BasicHand {
  Scalar mass = Scalar(0.05);        ///< mass of hand and stylus that moves with the tip, kg
  Scalar damping = Scalar(4);        ///< N s/m
  Scalar stiffness = Scalar(500);    ///< N/m
  Scalar tremor_rms = Scalar(3e-5);  ///< m, along each axis; 0 is no tremor. Illustrative
  Scalar tremor_hz = Scalar(9);      ///< Hz; physiological tremor is between 8 and 12 Hz

  void describe(auto& parameters) const { parameters.fields(mass, damping, stiffness, tremor_rms, tremor_hz); }
};

using Hand = BasicHand<double>;
using HandF = BasicHand<float>;

/// Physiological tremor: white noise through a resonance of quality 3, scaled to tremor_rms.
template <typename Scalar>
class BasicTremor {
 public:
  using Vector = Vector3<Scalar>;
  /// y(k) = a1 y(k-1) + a2 y(k-2) + b u(k), with white noise u, uniform between -0.5 and 0.5: TickNoise. The sum of
  /// many of them is nearly normal.
  struct Filter {
    Scalar a1{}, a2{}, b{};
  };

  BasicTremor(const BasicHand<Scalar>& hand, Scalar step) noexcept {
    if (hand.tremor_rms == 0) return;
    const Scalar omega = 2 * std::numbers::pi_v<Scalar> * hand.tremor_hz, quality = 3;
    const Scalar radius = std::exp(-omega / (2 * quality) * step);
    filter_.a1 = 2 * radius * std::cos(omega * std::sqrt(1 - 1 / (4 * quality * quality)) * step);
    filter_.a2 = -radius * radius;
    const Scalar a1 = filter_.a1, a2 = filter_.a2;
    const Scalar variance = (1 - a2) / ((1 + a2) * ((1 - a2) * (1 - a2) - a1 * a1));
    filter_.b = hand.tremor_rms * std::sqrt(12 / variance);
  }
  /// For lanes, which have no exp().
  explicit BasicTremor(const Filter& filter) noexcept : filter_(filter) {}

  /// The displacement in the next period, m.
  Vector step(const Vector& u) noexcept {
    const Vector y = filter_.a1 * y1_ + filter_.a2 * y2_ + filter_.b * u;
    y2_ = y1_;
    y1_ = y;
    return y;
  }
  bool is_off() const noexcept { return filter_.b == 0; }
  const Filter& filter() const noexcept { return filter_; }
  /// Starts the tremor of these lanes anew. filter: of all lanes from now on.
  void restart(const Mask<Scalar>& lanes, const Filter& filter) noexcept {
    using namespace lane;
    filter_ = filter;
    y1_ = select(lanes, Vector(), y1_);
    y2_ = select(lanes, Vector(), y2_);
  }

  static void archive(auto& self, auto& state) { state.fields(self.y1_, self.y2_); }

 private:
  Filter filter_{};
  Vector y1_ = Vector::Zero(), y2_ = Vector::Zero();
};

using Tremor = BasicTremor<double>;

}  // namespace punctura
