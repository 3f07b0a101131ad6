// The jump of the proxy within one tick: where the needle is at the pop, and what the force is before and after.
#pragma once

#include <cstddef>

#include "punctura/proxy/exact_friction.hpp"

namespace punctura::detail {

/// A jump of the force while the device moves from one sample to the next.
template <typename Scalar>
struct Jump {
  Scalar share;  ///< where it happens: 0 at the sample before, 1 at this sample
  Scalar drop;   ///< force after minus force before, N
  bool found = false;
};

/// One tick of a proxy that slides: how it began and ended.
template <typename Scalar>
struct SlidingTick {
  Scalar moved;      ///< of the device, m
  Scalar q_prev, q;  ///< of the proxy, m
  Scalar f_star, g;  ///< f*, N, by K06 (27), and g, N/m
};

/// The first depth between q_prev and q where the proxy jumps: there the edge rises faster than the coupling's line, so
/// a further step of the device finds no solution nearby. Returns false if the proxy moves without a jump.
///
/// before: the edge there, N, on the side that the proxy comes from.
template <int direction, typename Pieces>
bool jump_depth(const Pieces& band, const SlidingTick<typename Pieces::Scalar>& tick, typename Pieces::Scalar& depth,
                typename Pieces::Scalar& before) noexcept {
  using Scalar = typename Pieces::Scalar;
  const auto edge_of = [&](std::size_t i) { return direction > 0 ? band.piece(i).lower : band.piece(i).upper; };
  Scalar start = tick.q_prev;
  for (std::size_t i = band.index(tick.q_prev);; i = direction > 0 ? i + 1 : i - 1) {
    const Scalar origin = band.piece(i).origin;
    const auto edge = edge_of(i);
    const bool last = i == (direction > 0 ? band.last() : 0);
    const Scalar end = last ? tick.q : band.end(direction > 0 ? i : i - 1);
    const bool ends = last || direction * (tick.q - end) <= 0;
    const Scalar stop = ends ? tick.q : end;
    depth = start;
    before = edge.value(start - origin);
    if (edge.slope(start - origin) > tick.g) return true;
    if (edge.slope(stop - origin) > tick.g) {
      depth = origin + (tick.g - edge.c1) / (2 * edge.c2);
      before = edge.value(depth - origin);
      return true;
    }
    if (ends) return false;
    const std::size_t next = direction > 0 ? i + 1 : i - 1;
    depth = end;
    before = edge.value(end - origin);
    const Scalar rise = direction * (edge_of(next).value(end - band.piece(next).origin) - before);
    if (rise > 0 && rise * rise > 1e-16 * before * before) return true;  // less is rounding
    start = end;
  }
}

/// The jump of a tick in one direction: +1 in, -1 out.
template <int direction, typename Pieces>
Jump<typename Pieces::Scalar> find_jump(const Pieces& band, const SlidingTick<typename Pieces::Scalar>& tick) noexcept {
  using Scalar = typename Pieces::Scalar;
  Scalar at, before;
  if (!jump_depth<direction>(band, tick, at, before)) return {};
  // The device's way left at the jump, from f* + g (q - q_prev) = edge(q) for the device at that place.
  const Scalar left = (before - tick.f_star) / tick.g - (at - tick.q_prev);
  const Scalar behind = at + direction * 1e-9;  // past the jump, to find the next solution
  const Scalar line = tick.f_star + tick.g * (left + (behind - tick.q_prev));
  const Scalar after = slide<direction>(band, band.index(behind), behind, line, tick.g);
  return {1 - left / tick.moved, after - before, true};
}

}  // namespace punctura::detail
