// The two ways to solve K06 (21)-(23), and the state a membrane can be in.
#pragma once

#include <cstdint>

namespace punctura {

enum class Solver : std::uint8_t {
  paper,  ///< K06 (33): the band is taken at q*, which stands for q (31)
  exact,  ///< the true solution of (21)-(23)
};

/// What the needle is doing in one membrane.
enum class Phase : std::uint8_t {
  outside,
  sticking,     ///< the proxy rests: the force is inside the band
  sliding_in,   ///< the force is on the lower edge
  sliding_out,  ///< the force is on the upper edge
  barred,       ///< inside, but not entered from the front: no force until the tip has been outside, in front
};

/// Whether friction acts.
constexpr bool inside(Phase phase) noexcept { return phase != Phase::outside && phase != Phase::barred; }

}  // namespace punctura
