// The law of a block: each lane keeps the piece of its band in which it is, and seldom needs another.
#pragma once

#include "punctura/proxy/exact_friction.hpp"
#include "punctura_runtime/batch/line_block.hpp"

namespace punctura::batch {

/// The present pieces of the lanes from `start`. It takes the place of a PiecewiseBand in both solvers.
///
/// A lane leaves its piece in few ticks. Then its next piece comes from its BandTable, one lane after the other.
///
/// On a line, the depth of a tick is to the last bit that of the tick before, whose piece is present. in_space: it is
/// not, so a tick looks for its piece.
template <typename V, bool in_space = false>
class PresentPieces {
 public:
  using Scalar = V;

  PresentPieces() noexcept = default;
  PresentPieces(LineBlock& block, std::size_t start) noexcept : block_(&block), start_(start) {}

  /// The band at depth q (m), N.
  Band<V> band(const V& q) const noexcept {
    const auto within = at(block_->first) <= q && q <= at(block_->last);
    if (!all(within)) [[unlikely]]
      load(*block_, start_, q, !within);
    return band_here(q);
  }

  /// The band at the depth that the proxy had before the tick (m), N.
  Band<V> band_before(const V& q) const noexcept {
    if constexpr (in_space)
      return band(q);
    else
      return band_here(q);
  }

  /// The same if each lane is in its present piece.
  Band<V> band_here(const V& q) const noexcept {
    const V x = q - at(block_->origin);
    return {lower().value(x), upper().value(x)};
  }

  V first() const noexcept { return at(block_->first); }
  V last() const noexcept { return at(block_->last); }
  V origin() const noexcept { return at(block_->origin); }
  Quadratic<V> lower() const noexcept { return edge(block_->lower); }
  Quadratic<V> upper() const noexcept { return edge(block_->upper); }

  /// Solves the lanes of `lanes` one by one. Returns `force` with their forces, N.
  V solve_alone(const typename V::Mask& lanes, const V& q_prev, const V& f_star, const V& force) const noexcept {
    return exact_forces(*block_, start_, lanes, q_prev, f_star, force);
  }

 private:
  V at(const LaneNumbers& numbers) const noexcept { return V::load(numbers.of + start_); }
  Quadratic<V> edge(const LaneNumbers (&c)[3]) const noexcept { return {at(c[0]), at(c[1]), at(c[2])}; }

  // Static, so that the present pieces can stay in registers.
  [[gnu::noinline, gnu::cold]] static void load(LineBlock& block, std::size_t start, V q,
                                                typename V::Mask lanes) noexcept {
    alignas(64) double depth[V::lanes];
    q.store(depth);
    load_pieces(block, start, lanes.bits(), depth);
  }
  [[gnu::noinline, gnu::cold]] static V exact_forces(const LineBlock& block, std::size_t start, typename V::Mask lanes,
                                                     V q_prev, V f_star, V force) noexcept {
    alignas(64) double q[V::lanes], f[V::lanes], result[V::lanes];
    q_prev.store(q);
    f_star.store(f);
    force.store(result);
    batch::exact_forces(block, start, lanes.bits(), q, f, result);
    return V::load(result);
  }

  LineBlock* block_ = nullptr;
  std::size_t start_ = 0;
};

/// exact_friction() for lanes of which each is in its present piece at q_prev. Most slides end in that piece.
template <typename V, bool in_space>
Friction<V> exact_friction(const PresentPieces<V, in_space>& now, V q_prev, V f_star, V g) noexcept {
  using P = PhaseOf<V>;
  const Band<V> band = now.band_before(q_prev);
  const auto in = f_star < band.lower, slides = in || f_star > band.upper;
  if (!any(slides)) return {f_star, P(Phase::sticking)};

  const P phase = select(in, P(Phase::sliding_in), select(slides, P(Phase::sliding_out), P(Phase::sticking)));
  const Quadratic<V> edge = select(in, now.lower(), now.upper());
  const V direction = select(in, V(1), V(-1));
  const V y = q_prev - now.origin();
  const V gap = direction * (select(in, band.lower, band.upper) - f_star);
  const V x = first_root(direction * edge.c2, edge.slope(y) - g, gap);
  const V room = direction * (select(in, now.last(), now.first()) - q_prev);
  const auto stays = x >= 0 && x <= room;
  const V force = select(slides, edge.value(y + direction * x), f_star);
  const auto leaves = slides && !stays;
  if (!any(leaves)) return {force, phase};
  return {now.solve_alone(leaves, q_prev, f_star, force), phase};
}

/// A law for the solvers of core.
template <typename V>
class PresentLaw {
 public:
  using Scalar = V;
  PresentLaw(LineBlock& block, std::size_t start) noexcept : pieces_(block, start) {}
  const PresentPieces<V>& pieces() const noexcept { return pieces_; }

 private:
  PresentPieces<V> pieces_;
};

}  // namespace punctura::batch
