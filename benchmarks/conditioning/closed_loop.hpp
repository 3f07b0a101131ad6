// Closed loop: a simulated device in a simulated hand that rests in tissue.
#pragma once

#include <algorithm>

#include "punctura/lab/plant/plant.hpp"
#include "rig.hpp"

namespace bench {

struct Rest {
  double tick, speed, creep;  ///< N and m/s, rms over 4 s; m, displacement of the tip over these 4 s
};

/// Moves in to 12 mm in one second, out by 1.5 mm, then rests.
inline Rest at_rest(const Method& method, const punctura::DeviceDynamics& device, const punctura::Hand& hand,
                    punctura::Solver solver) {
  const Filter filter = method.make();
  auto model = bare_model(1e-3, solver);
  punctura::Plant plant(device, hand, T, 5);
  plant.place({0, 3e-3, 0});
  Vector3d previous = Vector3d::Zero(), begin = Vector3d::Zero();
  double tick = 0, speed = 0;
  constexpr int settled = 4800, ticks = 11200;
  for (int k = 0; k < ticks; ++k) {
    const double t = k * T;
    const double v = t < 1 ? 0 : t < 2 ? -15e-3 : t < 2.3 ? 5e-3 : 0;
    const double y = t < 1 ? 3e-3 : t < 2 ? 3e-3 - 15e-3 * (t - 1) : t < 2.3 ? -12e-3 + 5e-3 * (t - 2) : -10.5e-3;
    const Vector3d force = model.step(filter(plant.measured()), down);
    if (k == settled) begin = plant.tip();
    if (k > settled) {
      tick += (force - previous).squaredNorm() / (ticks - settled - 1);
      speed += plant.velocity().squaredNorm() / (ticks - settled - 1);
    }
    previous = force;
    plant.step(force, {{0, y, 0}, {0, v, 0}});
  }
  return {std::sqrt(tick), std::sqrt(speed), (plant.tip() - begin).norm()};
}

/// The Omni of the data sheet in a hand with a tremor of 0.03 mm, which the dry friction of the device suppresses.
inline Rest omni(const Method& method, punctura::Solver solver) { return at_rest(method, {}, {}, solver); }

/// The same encoder without friction, in a light grip without tremor: only the hand has damping.
inline Rest frictionless(const Method& method, punctura::Solver solver) {
  punctura::DeviceDynamics device;
  punctura::Hand hand;
  device.friction = 0;
  hand.tremor_rms = 0;
  hand.stiffness = 100;
  return at_rest(method, device, hand, solver);
}

/// Without friction, in a hand with tremor.
inline Rest trembling(const Method& method, punctura::Solver solver) {
  punctura::DeviceDynamics device;
  device.friction = 0;
  return at_rest(method, device, {}, solver);
}

/// The largest coupling stiffness, N/m, at which a sticking needle still stabilizes the bare device: the Omni's 45 g
/// without friction and without a hand, with an ideal sensor, displaced by less than a count.
inline double largest_stiffness(const Method& method) {
  const auto calms = [&](double stiffness) {
    const Filter filter = method.make();
    punctura::DeviceDynamics device;
    device.friction = device.encoder_step = 0;
    punctura::Plant plant(device, {0, 0, 0, 0, 1}, T);
    filter({0, 0, 0});
    plant.place({0, count / 4, 0});
    double y = 0, early = 0, late = 0;
    constexpr int ticks = 3200;
    for (int k = 0; k < ticks; ++k) {
      const double y_now = filter(plant.tip())[1];
      plant.step({0, -stiffness * y_now - B * (y_now - y) / T, 0}, {Vector3d::Zero(), Vector3d::Zero()});
      y = y_now;
      double& most = k < ticks / 2 ? early : late;
      most = std::max(most, std::abs(plant.tip()[1]));
    }
    return late < early / 2;
  };
  double low = 0, high = 10000;
  while (high - low > 5) (calms((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

}  // namespace bench
