// What a syringe holds, and the pressure that it takes in one tick.
#pragma once

#include <algorithm>

#include "punctura/syringe/syringe.hpp"

namespace punctura {

/// What a syringe holds between two ticks.
template <typename Scalar>
struct Contents {
  Scalar liquid;      ///< V_w, m^3
  Scalar air;         ///< n: the volume that the air has at the pressure of the atmosphere, m^3
  Scalar pressure{};  ///< P above that of the atmosphere, Pa
  Scalar left{};      ///< volume that left through the needle so far, m^3; air as it is in the syringe

  static void archive(auto& self, auto& state) {
    state.fields(self.liquid, self.air, self.pressure, self.left);
    state.require(self.liquid >= 0 && self.air >= 0);
  }
};

/// A volume that grows against the pressure: room(P) = volume + growth P. volume: m^3. growth: m^3/Pa, more than 0.
///
/// A plunger that is held has growth = C, the compliance of the barrel. A plunger that slides yields, and adds to it.
template <typename Scalar>
struct Room {
  Scalar volume, growth;
};

/// The pressure at which the contents fill the room, Pa. The only root.
///
/// Contents: liquid, of which flow (P - P_t) leaves within the tick, and air n, of which n P_0 / (P_0 + P) is left by
/// Boyle's law. They fill the room if
///
///     liquid - flow (P - P_t) + n P_0 / (P_0 + P) = volume + growth P.
///
/// With the absolute pressure y = P_0 + P, s = flow + growth and b = liquid + flow P_t - volume + s P_0, this is
/// s y^2 - b y - n P_0 = 0. The left side falls with P and the right side grows, so there is one root with y >= 0. For
/// b < 0 its usual form would lose digits by cancellation; the other form of the same root does not. Without air the
/// root can be negative: no liquid transmits tension, so y = 0, a vacuum.
template <typename Scalar>
constexpr Scalar filling_pressure(Scalar liquid, Scalar air, const Room<Scalar>& room, Scalar flow,
                                  Scalar outside) noexcept {
  const Scalar P_0 = static_cast<Scalar>(atmosphere);
  const Scalar s = flow + room.growth;
  // b, without the difference of two large numbers where there is no air
  const Scalar excess = (liquid - room.volume) + flow * outside;
  if (air == 0) return std::max(-P_0, excess / s);
  const Scalar b = excess + s * P_0;
  const Scalar root = lane::sqrt(b * b + 4 * s * air * P_0);
  return (b >= 0 ? (b + root) / (2 * s) : 2 * air * P_0 / (root - b)) - P_0;
}

/// The contents after a tick of period T (s) in the room, with the outlet at the needle's tip.
///
/// Implicit Euler: the flow of the tick is that of the new pressure, so no step is too long to be stable. The liquid
/// leaves first, then the air. If one of them ends within the tick, the other flows from the next tick on.
template <typename Scalar>
constexpr Contents<Scalar> filled(const Contents<Scalar>& before, const BasicSyringe<Scalar>& syringe,
                                  const BasicOutlet<Scalar>& outlet, const Room<Scalar>& room, Scalar T) noexcept {
  const Scalar P_0 = static_cast<Scalar>(atmosphere);
  const Scalar flow = T / (syringe.resistance + outlet.resistance);
  Contents<Scalar> after = before;
  if (before.liquid > 0 || before.air == 0) {
    after.pressure = filling_pressure(before.liquid, before.air, room, flow, outlet.pressure);
    const Scalar out = flow * (after.pressure - outlet.pressure);
    after.liquid = before.liquid - out;
    after.left = before.left + out;
    if (after.liquid >= 0) return after;
    after.liquid = 0;
    after.left = before.left + before.liquid;
    after.pressure = filling_pressure(Scalar(0), before.air, room, Scalar(0), Scalar(0));
    return after;
  }
  const Scalar easier = flow * static_cast<Scalar>(air_flows_easier);
  after.pressure = filling_pressure(Scalar(0), before.air, room, easier, outlet.pressure);
  const Scalar out = easier * (after.pressure - outlet.pressure);
  if (out < 0) {  // what flows back is liquid, which flows less easily
    after.pressure = filling_pressure(Scalar(0), before.air, room, flow, outlet.pressure);
    const Scalar in = flow * (outlet.pressure - after.pressure);
    after.liquid = std::max(Scalar(0), in);
    after.left = before.left - after.liquid;
    return after;
  }
  after.air = before.air - out * (P_0 + after.pressure) / P_0;
  after.left = before.left + out;
  if (after.air >= 0) return after;
  after.air = 0;
  after.left = before.left + before.air;
  after.pressure = filling_pressure(Scalar(0), Scalar(0), room, Scalar(0), Scalar(0));
  return after;
}

}  // namespace punctura
