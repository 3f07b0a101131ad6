// The ticks of a block with the solvers of core. It is compiled once for each instruction set.
#pragma once

#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"
#include "punctura_runtime/batch/isa.hpp"
#include "punctura_runtime/batch/present_pieces.hpp"
#include "punctura_runtime/batch/simd.hpp"

namespace punctura::batch {

/// Some vectors of a block, so that the processor computes one while another waits for a result.
template <typename V, typename Solver, std::size_t vectors>
class LineLanes {
 public:
  static constexpr std::size_t width = vectors * V::lanes;

  LineLanes(LineBlock& block, std::size_t start, const LineSpan& span) noexcept : block_(block), start_(start) {
    for (std::size_t j = 0; j < vectors; ++j) {
      State& s = state_[j];
      s.started = typename V::Mask(true);
      // Before the first tick, p(k-1) is p(k).
      s.p = block.started ? at(block.p, j) : depth(span, 0, j);
      s.e = at(block.e, j);
      s.f = at(block.f, j);
      PresentPieces<V>(block, first_lane(j)).band(s.p + s.e);  // loads the pieces
    }
  }

  bool run(const LineSpan& span) noexcept {
    typename V::Mask good(true);
    for (std::size_t k = 0; k < span.ticks; ++k) {
#pragma GCC unroll 4
      for (std::size_t j = 0; j < vectors; ++j) {
        const V p = depth(span, k, j);
        good = good && V(-1e6) <= p && p <= V(1e6);
        const auto tick = Solver::step(params(j), state_[j], p);
        if (span.force)
          tick.force.store(span.force + static_cast<std::ptrdiff_t>(k) * span.force_stride + first_lane(j));
      }
    }
    for (std::size_t j = 0; j < vectors; ++j) {
      state_[j].p.store(block_.p.of + first_lane(j));
      state_[j].e.store(block_.e.of + first_lane(j));
      state_[j].f.store(block_.f.of + first_lane(j));
    }
    return all(good);
  }

 private:
  using Law = PresentLaw<V>;
  using State = LineState<Law>;

  std::size_t first_lane(std::size_t j) const noexcept { return start_ + j * V::lanes; }
  V at(const LaneNumbers& numbers, std::size_t j) const noexcept { return V::load(numbers.of + first_lane(j)); }
  V depth(const LineSpan& span, std::size_t k, std::size_t j) const noexcept {
    const double* row = span.p + static_cast<std::ptrdiff_t>(k) * span.p_stride;
    return span.shared ? V(*row) : V::load(row + first_lane(j));
  }
  LineParams<Law> params(std::size_t j) const noexcept {
    SampledCoupling<V> coupling({at(block_.K, j), V(0)}, V(1));
    coupling.g = at(block_.g, j);
    coupling.inv_g = at(block_.inv_g, j);
    coupling.B_over_D = at(block_.B_over_D, j);
    return {Law(block_, first_lane(j)), coupling};
  }

  LineBlock& block_;
  std::size_t start_;
  State state_[vectors];
};

template <typename Isa, typename Solver>
bool run_line(LineBlock& block, const LineSpan& span) noexcept {
  using Lanes = LineLanes<Simd<Isa>, Solver, 4>;
  bool good = true;
  for (std::size_t start = 0; start < block_lanes; start += Lanes::width)
    good = Lanes(block, start, span).run(span) && good;
  block.started = true;
  return good;
}

}  // namespace punctura::batch
