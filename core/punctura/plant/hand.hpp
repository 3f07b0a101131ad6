// The hand that holds the stylus.
#pragma once

#include <cmath>
#include <numbers>

#include "punctura/model/vector3.hpp"
#include "punctura/plant/noise.hpp"

namespace punctura {

/// Where the hand wants the tip to be.
struct Desired {
  Vector3d position;  ///< m
  Vector3d velocity;  ///< m/s
};

/// Mass, and a spring and a damper to the desired motion. The second-order form and the order of magnitude are those of
/// measured pen-hold and pinch grasps (Hasser and Cutkosky 2002; Fu and Cavusoglu 2012); the numbers are illustrative, since
/// stiffness and damping change several-fold with grip force and from person to person.
struct Hand {
  double mass = 0.05;        ///< kg, of hand and stylus that moves with the tip
  double damping = 4;        ///< N s/m
  double stiffness = 500;    ///< N/m
  double tremor_rms = 3e-5;  ///< m, along each axis; 0 is a hand that never trembles. Illustrative
  double tremor_hz = 9;      ///< physiological tremor lies between 8 and 12 Hz
};

/// Physiological tremor: white noise through a resonance of quality 3, with the rms asked for.
class Tremor {
 public:
  Tremor(const Hand& hand, double step) noexcept {
    if (hand.tremor_rms == 0) return;
    const double omega = 2 * std::numbers::pi * hand.tremor_hz, quality = 3;
    const double radius = std::exp(-omega / (2 * quality) * step);
    a1_ = 2 * radius * std::cos(omega * std::sqrt(1 - 1 / (4 * quality * quality)) * step);
    a2_ = -radius * radius;
    // Variance of y = a1 y' + a2 y'' + b u for white u of variance 1, solved for b.
    const double variance = (1 - a2_) / ((1 + a2_) * ((1 - a2_) * (1 - a2_) - a1_ * a1_));
    b_ = hand.tremor_rms / std::sqrt(variance);
  }

  Vector3d step(Noise& noise) noexcept {
    if (b_ == 0) return Vector3d::Zero();
    const Vector3d u(noise.normal(), noise.normal(), noise.normal());
    const Vector3d y = a1_ * y1_ + a2_ * y2_ + b_ * u;
    y2_ = y1_;
    y1_ = y;
    return y;
  }

 private:
  double a1_ = 0, a2_ = 0, b_ = 0;
  Vector3d y1_ = Vector3d::Zero(), y2_ = Vector3d::Zero();
};

}  // namespace punctura
