// A custom law that feels time: a skin whose hole heals.
#pragma once

#include <algorithm>

#include "punctura/model/law.hpp"

namespace punctura::test {

struct Wound {
  double front = 0;   ///< the deepest point of this insertion, m
  double hole = 0;    ///< the deepest point of all insertions, m
  double healed = 0;  ///< of the hole in front of `front`: 0, open, to 1
  static void archive(auto& self, auto& state) { state.fields(self.front, self.hole, self.healed); }
};
/// To cut needs 1 N, down to 2 mm. The hole of the needle that has left closes with a time constant of 2 s.
struct HealingLaw {
  using Scalar = double;
  using Memory = Wound;
  static constexpr double bottom = 2e-3, time_constant = 2;

  PiecewiseBand<double, 5> pieces(double = 1, const Memory& m = {}) const noexcept {
    const double front = std::min(m.front, bottom), hole = std::clamp(m.hole, front, bottom);
    const auto cut = [](double force) { return BandPiece<double>{0, {-0.05 - force, 0, 0}, {0.05, 0, 0}}; };
    // A piece without length is still a wall, so it has the force of its neighbour.
    return {{0, front, hole, bottom}, {{{}, cut(0), cut(m.healed), cut(hole < bottom ? 1 : m.healed), cut(0)}}};
  }
  bool advance(Memory& m, double depth, double dt) const noexcept {
    if (depth > 0) return depth > m.front && (m.front = depth, true);
    if (m.front > 0) m = {0, std::max(m.front, m.hole), m.front >= m.hole ? 0 : m.healed};  // it has left
    m.healed += (1 - m.healed) * dt / time_constant;
    return true;
  }
};

}  // namespace punctura::test
