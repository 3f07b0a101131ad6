// What many tests use: the paper's period, no force, and the needle's direction. All tests of a folder are compiled as
// one source file, so each of these names exists once, here.
#pragma once

#include <array>

#include "punctura/model/vector3.hpp"

namespace punctura::test {

inline constexpr double T = 1 / 1600.0;                ///< period of a tick, s
inline constexpr std::array<double, 3> zero{0, 0, 0};  ///< no force, N
inline const Vector3d down(0, -1, 0);                  ///< direction of a needle that comes from above

}  // namespace punctura::test
