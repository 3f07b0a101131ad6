// The true solution of K06 (21)-(23): where the proxy stops, and with what force.
#pragma once

#include <cmath>
#include <cstddef>

#include "punctura/model/piecewise_band.hpp"
#include "punctura/proxy/solver.hpp"

namespace punctura {

/// The friction force of one tick, and what the proxy did under it.
template <typename Scalar>
struct Friction {
  Scalar force;  ///< N, along the needle
  Phase phase;
};

/// First x > 0 with c + b x + a x^2 = 0 for c > 0, or a negative number or NaN where there is none.
///
/// The smaller root of a parabola that starts above zero is 2c / (sqrt(b^2 - 4ac) - b), whatever the sign of a. Where b > 0
/// that denominator cancels (then a < 0, or there is no root), and the same root is written from the other side.
template <typename Scalar>
Scalar first_root(Scalar a, Scalar b, Scalar c) noexcept {
  if (a == 0) return -c / b;  // a straight piece, as most are: the same number without the square root
  const Scalar root = std::sqrt(b * b - 4 * a * c);
  return b <= 0 ? 2 * c / (root - b) : -(root + b) / (2 * a);
}

/// Slides the proxy from q_prev, in piece i, in one direction (+1 in, -1 out) to the first depth where the coupling's force
/// f* + g (q - q_prev), by (26), meets the edge of the band: the continuation of the motion when there are several.
///
/// With x the distance slid, gap(x) = direction (edge(q) - f*) - g x starts positive and ends negative, since the edges
/// are bounded. On each piece it is at most quadratic; at a break where the edge jumps (thin law) gap may pass zero in the
/// jump, and the proxy then rests on the break with a force between the two edges.
template <int direction, typename Pieces>
typename Pieces::Scalar slide(const Pieces& band, std::size_t i, typename Pieces::Scalar q_prev,
                              typename Pieces::Scalar f_star, typename Pieces::Scalar g) noexcept {
  using Scalar = typename Pieces::Scalar;
  constexpr std::size_t last = direction > 0 ? Pieces::size - 1 : 0;
  Scalar start = q_prev;
  for (;; i = direction > 0 ? i + 1 : i - 1) {
    const auto& piece = band.pieces[i];
    const auto& edge = direction > 0 ? piece.lower : piece.upper;
    const Scalar y = start - piece.origin;
    const Scalar coupling = f_star + g * (start - q_prev);
    const Scalar gap = direction * (edge.value(y) - coupling);
    if (gap <= 0) return coupling;
    if (i == last) return edge.c0;  // constant from here on: the coupling meets it somewhere

    const Scalar x = first_root(direction * edge.c2, edge.slope(y) - g, gap);
    const Scalar end = band.breaks[direction > 0 ? i : i - 1];
    if (x >= 0 && x <= direction * (end - start)) return edge.value(y + direction * x);
    start = end;
  }
}

/// Solves K06 (21)-(23) for one tick from the band at q_prev.
///
/// f*, by (27), is what holds the proxy still. If the band at q_prev allows it, the proxy sticks; else it slides towards
/// the side on which f* lies. Bounded time: every piece is visited at most once.
template <typename Pieces>
Friction<typename Pieces::Scalar> exact_friction(const Pieces& pieces, typename Pieces::Scalar q_prev,
                                                 typename Pieces::Scalar f_star, typename Pieces::Scalar g) noexcept {
  const std::size_t i = pieces.index(q_prev);
  const auto band = pieces.band(q_prev, i);
  if (f_star < band.lower) return {slide<+1>(pieces, i, q_prev, f_star, g), Phase::sliding_in};
  if (f_star > band.upper) return {slide<-1>(pieces, i, q_prev, f_star, g), Phase::sliding_out};
  return {f_star, Phase::sticking};
}

/// K06 (32): the clamp of f* to the band at q*, and the phase that (29) reads from it.
template <typename Scalar>
Friction<Scalar> clamped_friction(const Band<Scalar>& band, Scalar f_star) noexcept {
  const Scalar f = band.clamp(f_star);
  return {f, f > f_star ? Phase::sliding_in : f < f_star ? Phase::sliding_out : Phase::sticking};
}

}  // namespace punctura
