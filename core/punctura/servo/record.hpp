// What a membrane's proxy gave, as a tick's record has it.
#pragma once

#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

template <typename Scalar>
MembraneRecord record_of(const SpaceTick<Scalar>& t) noexcept {
  return {t.depth, t.axial_force, t.band.lower, t.band.upper, to_array(t.proxy), to_array(t.direction), t.phase};
}

/// On a line, the needle's direction is the first axis.
template <typename Scalar>
MembraneRecord record_of(const LineTick<Scalar>& t) noexcept {
  return {t.depth, t.force, t.band.lower, t.band.upper, {t.proxy, 0, 0}, {1, 0, 0}, t.phase};
}

}  // namespace punctura
