// The viscous damping that a device needs so that it cannot oscillate against the virtual coupling of a scene.
//
// Do not call it in a tick.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "punctura/scene/scene.hpp"
#include "punctura/signal/conditioning.hpp"

namespace punctura {

/// The damping of the device, N s/m, above which it is passive in any grip while every membrane holds the needle:
///
///     b > T/2 / (1 - cos wT) Re[(1 - z^-1) H(z)]  at z = exp(j w T), for 0 < w <= pi / T
///
/// (Colgate and Schenkel 1997). H is the coupling (21), with its branches, behind the position filter, times the number
/// of membranes: a needle that is through a membrane is still held by it. H has one value for each window of a line
/// fit; the largest b counts. It is for a force scale of 1, and proportional to the scale. The play of the line fit and
/// the steps of the encoder need dry friction besides (docs/passivity.md). scene must have passed check().
inline double needed_damping(const Scene& scene) {
  using Filter = PositionConditioner<double>;
  constexpr std::size_t frequencies = 2048;
  const ServoSettings& servo = scene.servo;
  const double T = 1 / servo.rate;
  const Filter filter(servo.conditioning, servo.low_pass, servo.encoder_step, T);
  const auto coupling = RelaxingCoupling<double>(scene.coupling, scene.relaxation, T).constants();
  double largest = 0;
  std::array<double, Filter::Line::most_samples> weights{1};
  const auto look = [&](std::size_t samples) {
    for (std::size_t i = 1; i <= frequencies; ++i) {
      const double wT = std::numbers::pi * static_cast<double>(i) / frequencies;
      const auto delay = std::polar(1.0, -wT);  // z^-1
      std::complex<double> fitted = 0, per_step = scene.coupling.damping * servo.rate;
      for (std::size_t age = samples; age-- > 0;) fitted = fitted * delay + weights[age];
      for (std::size_t k = 0; k < coupling.count; ++k)
        per_step += coupling.branches[k].k / (1.0 - coupling.branches[k].a * delay);
      const double gain = filter.low_pass_gain();
      const auto position = fitted * gain / (1.0 - (1 - gain) * delay);
      const auto force = (coupling.K + per_step * (1.0 - delay)) * position;
      largest = std::max(largest, T / 2 / (1 - std::cos(wT)) * std::real((1.0 - delay) * force));
    }
  };
  look(1);
  if (servo.encoder_step > 0 && filter.line() != nullptr)
    for (std::size_t n = filter.line()->size(); n >= 3; n = Filter::Line::shorter(n)) {
      for (std::size_t age = 0; age < n; ++age) weights[age] = filter.line()->weight(n, age);
      look(n);
    }
  return static_cast<double>(scene.membranes.size()) * largest;
}

}  // namespace punctura
