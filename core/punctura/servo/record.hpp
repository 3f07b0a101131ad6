// Converts the result of a proxy to the record of a membrane.
#pragma once

#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

/// The record of a tick in space.
template <typename Scalar>
MembraneRecord record_of(const SpaceTick<Scalar>& t) noexcept {
  return {t.depth, t.axial_force, t.band.lower, t.band.upper, to_array(t.proxy), to_array(t.direction), t.phase};
}

/// The record of a tick on a line. The needle's direction is the x axis.
template <typename Scalar>
MembraneRecord record_of(const LineTick<Scalar>& t) noexcept {
  return {t.depth, t.force, t.band.lower, t.band.upper, {t.proxy, 0, 0}, {1, 0, 0}, t.phase};
}

}  // namespace punctura
