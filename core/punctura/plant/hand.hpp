// A model of the hand that holds the stylus.
#pragma once

#include <cmath>
#include <numbers>

#include "punctura/model/vector3.hpp"
#include "punctura/plant/noise.hpp"

namespace punctura {

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

  void describe(auto& parameters) const { parameters.numbers(mass, damping, stiffness, tremor_rms, tremor_hz); }
};

using Hand = BasicHand<double>;
using HandF = BasicHand<float>;

/// Physiological tremor: white noise through a resonance of quality 3, scaled to tremor_rms.
template <typename Scalar>
class BasicTremor {
 public:
  using Vector = Vector3<Scalar>;

  BasicTremor(const BasicHand<Scalar>& hand, Scalar step) noexcept {
    if (hand.tremor_rms == 0) return;
    const Scalar omega = 2 * std::numbers::pi_v<Scalar> * hand.tremor_hz, quality = 3;
    const Scalar radius = std::exp(-omega / (2 * quality) * step);
    a1_ = 2 * radius * std::cos(omega * std::sqrt(1 - 1 / (4 * quality * quality)) * step);
    a2_ = -radius * radius;
    // b_ from the variance of y(k) = a1 y(k-1) + a2 y(k-2) + b u(k), with white noise u of variance 1.
    const Scalar variance = (1 - a2_) / ((1 + a2_) * ((1 - a2_) * (1 - a2_) - a1_ * a1_));
    b_ = hand.tremor_rms / std::sqrt(variance);
  }

  /// The displacement in the next period, m.
  Vector step(Noise& noise) noexcept {
    if (b_ == 0) return Vector::Zero();
    const Vector u = noise.normal_vector().template cast<Scalar>();
    const Vector y = a1_ * y1_ + a2_ * y2_ + b_ * u;
    y2_ = y1_;
    y1_ = y;
    return y;
  }

  static void archive(auto& self, auto& state) { state.numbers(self.y1_, self.y2_); }

 private:
  Scalar a1_ = 0, a2_ = 0, b_ = 0;
  Vector y1_ = Vector::Zero(), y2_ = Vector::Zero();
};

using Tremor = BasicTremor<double>;

}  // namespace punctura
