// The true solution of K06 (21)-(23): where the proxy stops, and with what force.
#pragma once

#include <cstddef>

#include "punctura/model/piecewise_band.hpp"
#include "punctura/proxy/solver.hpp"

namespace punctura {

/// The friction force of one tick, and what the proxy did under it.
template <typename Scalar>
struct Friction {
  Scalar force;  ///< N, along the needle
  PhaseOf<Scalar> phase;
};

/// First x > 0 with c + b x + a x^2 = 0 for c > 0, or a negative number or NaN where there is none.
///
/// The smaller root of a parabola that starts above zero is 2c / (sqrt(b^2 - 4ac) - b), whatever the sign of a. Where b > 0
/// that denominator cancels (then a < 0, or there is no root), and the same root is written from the other side.
template <typename Scalar>
Scalar first_root(Scalar a, Scalar b, Scalar c) noexcept {
  using namespace lane;
  if constexpr (OneNumber<Scalar>)
    if (a == 0) return -c / b;  // a straight piece, as most are: the same number without the square root
  const Scalar root = sqrt(b * b - 4 * a * c);
  const Scalar curved = select(b <= 0, 2 * c / (root - b), -(root + b) / (2 * a));
  return select(a == 0, -c / b, curved);
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

/// The same for lanes. Each lane starts and stops in a piece of its own, so all lanes visit all pieces, and each keeps the first force
/// that it finds. slide() stands beside it for speed: one number mostly needs one piece, and leaves the others out.
template <int direction, typename Pieces>
typename Pieces::Scalar masked_slide(const Pieces& band, typename Pieces::Scalar q_prev, typename Pieces::Scalar f_star,
                                     typename Pieces::Scalar g) noexcept {
  using namespace lane;
  using Scalar = typename Pieces::Scalar;
  constexpr std::size_t last = Pieces::size - 1;
  Scalar start = q_prev, force = f_star;
  Mask<Scalar> sliding(false), stopped(false);
  for (std::size_t trip = 0; trip <= last; ++trip) {
    const std::size_t i = direction > 0 ? trip : last - trip;
    const auto& piece = band.pieces[i];
    const auto& edge = direction > 0 ? piece.lower : piece.upper;
    // A lane joins in the piece that holds q_prev.
    if (trip == last)
      sliding = Mask<Scalar>(true);
    else
      sliding = sliding || (direction > 0 ? !band.behind(i, q_prev) : Mask<Scalar>(band.behind(i - 1, q_prev)));
    const Scalar y = start - piece.origin;
    const Scalar coupling = f_star + g * (start - q_prev);
    const Scalar gap = direction * (edge.value(y) - coupling);
    const auto met = gap <= 0;
    force = select(sliding && !stopped && met, coupling, force);
    stopped = stopped || (sliding && met);
    if (trip == last) return select(stopped, force, edge.c0);

    const Scalar x = first_root(direction * edge.c2, edge.slope(y) - g, gap);
    const Scalar end = band.breaks[direction > 0 ? i : i - 1];
    const auto within = x >= 0 && x <= direction * (end - start);
    force = select(sliding && !stopped && within, edge.value(y + direction * x), force);
    stopped = stopped || (sliding && within);
    start = select(sliding, end, start);
  }
  return force;
}

/// Solves K06 (21)-(23) for one tick from the band at q_prev.
///
/// f*, by (27), is what holds the proxy still. If the band at q_prev allows it, the proxy sticks; else it slides towards
/// the side on which f* lies. Bounded time: every piece is visited at most once.
template <typename Pieces>
Friction<typename Pieces::Scalar> exact_friction(const Pieces& pieces, typename Pieces::Scalar q_prev,
                                                 typename Pieces::Scalar f_star, typename Pieces::Scalar g) noexcept {
  using namespace lane;
  using Scalar = typename Pieces::Scalar;
  if constexpr (OneNumber<Scalar>) {
    const std::size_t i = pieces.index(q_prev);
    const auto band = pieces.band(q_prev, i);
    if (f_star < band.lower) return {slide<+1>(pieces, i, q_prev, f_star, g), Phase::sliding_in};
    if (f_star > band.upper) return {slide<-1>(pieces, i, q_prev, f_star, g), Phase::sliding_out};
    return {f_star, Phase::sticking};
  } else {
    const auto band = pieces.band(q_prev);
    const auto in = f_star<band.lower, out = f_star> band.upper;
    Friction<Scalar> friction{f_star, Phase::sticking};
    if (any(out)) friction.force = select(out, masked_slide<-1>(pieces, q_prev, f_star, g), friction.force);
    if (any(in)) friction.force = select(in, masked_slide<+1>(pieces, q_prev, f_star, g), friction.force);
    friction.phase = select(out, PhaseOf<Scalar>(Phase::sliding_out), friction.phase);
    friction.phase = select(in, PhaseOf<Scalar>(Phase::sliding_in), friction.phase);
    return friction;
  }
}

/// K06 (32): the clamp of f* to the band at q*, and the phase that (29) reads from it.
template <typename Scalar>
Friction<Scalar> clamped_friction(const Band<Scalar>& band, Scalar f_star) noexcept {
  using namespace lane;
  using P = PhaseOf<Scalar>;
  const Scalar f = band.clamp(f_star);
  if constexpr (OneNumber<Scalar>)  // select() would compute both comparisons: 4 % of a tick of many membranes
    return {f, f > f_star ? Phase::sliding_in : f < f_star ? Phase::sliding_out : Phase::sticking};
  else
    return {f, select(f > f_star, P(Phase::sliding_in), select(f < f_star, P(Phase::sliding_out), P(Phase::sticking)))};
}

}  // namespace punctura
