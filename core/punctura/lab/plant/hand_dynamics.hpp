// A hand that holds the stylus, and its desired motion.
#pragma once

#include "punctura/model/vector3.hpp"

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

}  // namespace punctura
