// The friction force of one tick: the true solution of K06 (21)-(23), and the paper's clamp (32).
#pragma once

#include <cstddef>
#include <type_traits>

#include "punctura/model/piecewise_band.hpp"
#include "punctura/proxy/solver.hpp"

namespace punctura {

/// The friction force of one tick, and the resulting phase.
template <typename Scalar>
struct Friction {
  Scalar force;  ///< N, along the needle
  PhaseOf<Scalar> phase;
};

/// The first root x > 0 of c + b x + a x^2 for c > 0. A negative number or NaN if there is no such root.
///
/// The parabola starts above zero. Its first root is 2c / (sqrt(b^2 - 4ac) - b) for both signs of a. For b > 0 the
/// denominator loses digits by cancellation. Then either a < 0 or there is no root, and -(sqrt(b^2 - 4ac) + b) / 2a
/// is the same root without cancellation.
template <typename Scalar>
constexpr Scalar first_root(Scalar a, Scalar b, Scalar c) noexcept {
  using namespace lane;
  const auto straight = a == 0;
  if (all(straight)) return -c / b;  // most pieces are straight: this skips the square root
  const Scalar square = b * b - 4 * a * c;
  if constexpr (OneNumber<Scalar>)
    if (std::is_constant_evaluated() && square < 0) return Scalar(-1);  // Clang has no NaN in a constant
  const Scalar root = sqrt(square);
  const auto falls = b <= 0;
  const Scalar numerator = select(falls, 2 * c, -(root + b)), denominator = select(falls, root - b, 2 * a);
  return select(straight, -c, numerator) / select(straight, b, denominator);
}

/// Slides the proxy from q_prev (m) in one direction: +1 in, -1 out. Returns the friction force, N. Piece i contains
/// q_prev.
///
/// The proxy stops at the first depth where the force of the coupling, f* + g (q - q_prev) by (26), equals the edge
/// of the band. If there are several such depths, the first one continues the motion.
///
/// x is the distance that the proxy slides. gap(x) = direction (edge(q) - f*) - g x starts positive and ends
/// negative, because the edges are bounded. On each piece, gap is at most quadratic. At a break where the edge jumps
/// (thin law), gap can change its sign in the jump. The proxy then rests on the break, and its force lies between the
/// two values of the edge.
template <int direction, typename Pieces>
[[gnu::noinline]] constexpr typename Pieces::Scalar slide(const Pieces& band, std::size_t i,
                                                          typename Pieces::Scalar q_prev,
                                                          typename Pieces::Scalar f_star,
                                                          typename Pieces::Scalar g) noexcept {
  using Scalar = typename Pieces::Scalar;
  const std::size_t last = direction > 0 ? band.last() : 0;
  Scalar start = q_prev;
  for (;; i = direction > 0 ? i + 1 : i - 1) {
    const auto& piece = band.piece(i);
    const auto& edge = direction > 0 ? piece.lower : piece.upper;
    const Scalar y = start - piece.origin;
    const Scalar coupling = f_star + g * (start - q_prev);
    const Scalar gap = direction * (edge.value(y) - coupling);
    if (gap <= 0) return coupling;
    if (i == last) return edge.c0;  // the edge is constant from here on, so the coupling reaches it

    const Scalar x = first_root(direction * edge.c2, edge.slope(y) - g, gap);
    const Scalar end = band.end(direction > 0 ? i : i - 1);
    if (x >= 0 && x <= direction * (end - start)) return edge.value(y + direction * x);
    start = end;
  }
}

/// slide() for lanes. Lanes start and stop in different pieces. Therefore all lanes visit all pieces, and each lane
/// keeps the first force that it finds.
///
/// slide() is faster for one number: it mostly needs one piece and skips the others.
template <int direction, typename Pieces>
constexpr typename Pieces::Scalar masked_slide(const Pieces& band, typename Pieces::Scalar q_prev,
                                               typename Pieces::Scalar f_star, typename Pieces::Scalar g) noexcept {
  using namespace lane;
  using Scalar = typename Pieces::Scalar;
  constexpr std::size_t last = Pieces::size - 1;
  Scalar start = q_prev, force = f_star;
  Mask<Scalar> sliding(false), stopped(false);
  for (std::size_t trip = 0; trip <= last; ++trip) {
    const std::size_t i = direction > 0 ? trip : last - trip;
    const auto& piece = band.pieces[i];
    const auto& edge = direction > 0 ? piece.lower : piece.upper;
    // A lane starts in the piece that contains q_prev.
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

/// Solves K06 (21)-(23) for one tick. q_prev: m. f_star: f*, N, by (27). g: N/m.
///
/// f* holds the proxy still. If f* lies in the band at q_prev, the proxy sticks. If f* is below the band, the proxy
/// slides in. If f* is above the band, it slides out. Each piece is visited at most once, so the time is bounded.
template <typename Pieces>
[[gnu::always_inline]] constexpr Friction<typename Pieces::Scalar> exact_friction(const Pieces& pieces,
                                                                                  typename Pieces::Scalar q_prev,
                                                                                  typename Pieces::Scalar f_star,
                                                                                  typename Pieces::Scalar g) noexcept {
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

/// f* (N), clamped to the band at q*, K06 (32), and the phase by (29).
template <typename Scalar>
constexpr Friction<Scalar> clamped_friction(const Band<Scalar>& band, Scalar f_star) noexcept {
  using namespace lane;
  using P = PhaseOf<Scalar>;
  const Scalar f = band.clamp(f_star);
  if constexpr (OneNumber<Scalar>)  // select() always computes both comparisons: 4 % of a tick with many membranes
    return {f, f > f_star ? Phase::sliding_in : f < f_star ? Phase::sliding_out : Phase::sticking};
  else
    return {f, select(f > f_star, P(Phase::sliding_in), select(f < f_star, P(Phase::sliding_out), P(Phase::sticking)))};
}

}  // namespace punctura
