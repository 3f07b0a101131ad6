// The tremor of the hand that holds the stylus.
#pragma once

#include <cmath>
#include <numbers>

#include "punctura/lab/plant/hand_dynamics.hpp"

namespace punctura {

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

  static void archive(auto& self, auto& state) { state.numbers(self.y1_, self.y2_); }

 private:
  Filter filter_{};
  Vector y1_ = Vector::Zero(), y2_ = Vector::Zero();
};

using Tremor = BasicTremor<double>;

}  // namespace punctura
