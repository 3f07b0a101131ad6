// The ticks of a block with the solvers of core. It is compiled once for each instruction set.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"
#include "punctura_runtime/batch/isa.hpp"
#include "punctura_runtime/batch/present_pieces.hpp"
#include "punctura_runtime/batch/simd.hpp"

namespace punctura::batch {

/// One vector of a block: its state, in registers while run_vectors() is at work.
template <typename V, typename Solver>
class LineVector {
 public:
  LineVector(LineBlock& block, std::size_t lane, const LineSpan& span) noexcept {
    state_.p = block.started ? at(block.p, lane) : depth(span, 0, lane);  // before the first tick, p(k-1) is p(k)
    state_.e = at(block.e, lane);
    state_.f = at(block.f, lane);
    PresentPieces<V>(block, lane).band(state_.p + state_.e);  // loads the pieces
  }

  /// One tick. p: depth of the device, m. Returns the force, N.
  V step(LineBlock& block, std::size_t lane, V p) noexcept {
    SampledCoupling<V> coupling({at(block.K, lane), V(0)}, V(1));
    coupling.g = at(block.g, lane);
    coupling.inv_g = at(block.inv_g, lane);
    coupling.B_over_D = at(block.B_over_D, lane);
    state_.started = typename V::Mask(true);
    return Solver::step(LineParams<PresentLaw<V>>{PresentLaw<V>(block, lane), coupling}, state_, p).force;
  }

  void store(LineBlock& block, std::size_t lane) const noexcept {
    state_.p.store(block.p.of + lane);
    state_.e.store(block.e.of + lane);
    state_.f.store(block.f.of + lane);
  }

  static V depth(const LineSpan& span, std::size_t tick, std::size_t lane) noexcept {
    const double* row = span.p + static_cast<std::ptrdiff_t>(tick) * span.p_stride;
    return span.shared ? V(*row) : V::load(row + lane);
  }

 private:
  static V at(const LaneNumbers& numbers, std::size_t lane) noexcept { return V::load(numbers.of + lane); }

  LineState<PresentLaw<V>> state_{};
};

/// How far ahead run_vectors() fetches depths and places for forces.
inline constexpr std::ptrdiff_t rows_ahead = 12;

/// Asks for the memory `ahead` doubles behind an address. It may lie behind the end of an array.
inline void fetch([[maybe_unused]] const double* from, [[maybe_unused]] std::ptrdiff_t ahead) noexcept {
#if defined(__GNUC__)
  const auto bytes = static_cast<std::uintptr_t>(ahead) * sizeof(double);
  __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(from) + bytes));
#endif
}

/// The ticks of several vectors. They take turns, so that the processor computes one while another waits for a result.
///
/// start: the first lane. If it is an integral_constant, the numbers of the block have fixed places.
template <typename V, typename Solver, bool shared, bool stores, typename Start, std::size_t... j>
[[gnu::flatten]] bool run_vectors(LineBlock& block, Start start, const LineSpan& span,
                                  std::index_sequence<j...>) noexcept {
  using Vector = LineVector<V, Solver>;
  Vector vectors[] = {Vector(block, start + j * V::lanes, span)...};
  typename V::Mask good(true);
  const double* p = span.p;
  double* force = span.force;
  const std::ptrdiff_t p_stride = span.p_stride, force_stride = span.force_stride;
  for (std::size_t k = span.ticks; k > 0; --k, p += p_stride) {
    const auto tick = [&](Vector& vector, std::size_t lane) {
      const V depth = shared ? V(*p) : V::load(p + lane);
      // The rows may be pages apart, where the processor does not fetch ahead by itself.
      if constexpr (!shared) fetch(p + lane, rows_ahead * p_stride);
      if constexpr (stores) fetch(force + lane, rows_ahead * force_stride);
      good = good && V(-1e6) <= depth && depth <= V(1e6);
      const V f = vector.step(block, lane, depth);
      if constexpr (stores) f.store(force + lane);
    };
    (tick(vectors[j], start + j * V::lanes), ...);
    if constexpr (stores) force += force_stride;
  }
  (vectors[j].store(block, start + j * V::lanes), ...);
  return all(good);
}

template <typename Isa, typename Solver>
bool run_line(LineBlock& block, const LineSpan& span) noexcept {
  using V = Simd<Isa>;
  constexpr auto run = [](auto shared, auto stores, LineBlock& b, const LineSpan& s) noexcept {
    constexpr std::size_t together = 4, width = together * V::lanes;  // several vectors hide the wait for a result
    constexpr std::make_index_sequence<together> vectors;
    constexpr std::size_t turns = block_lanes / width;
    bool good = true;
    const auto turn = [&](auto start) {
      good = run_vectors<V, Solver, shared.value, stores.value>(b, start, s, vectors) && good;
    };
    if constexpr (turns <= 2)  // with more, the code for each would be long
      [&]<std::size_t... i>(std::index_sequence<i...>) {
        (turn(std::integral_constant<std::size_t, i * width>()), ...);
      }(std::make_index_sequence<turns>());
    else
      for (std::size_t start = 0; start < block_lanes; start += width) turn(start);
    return good;
  };
  constexpr std::true_type yes;
  constexpr std::false_type no;
  const bool good = span.shared  ? span.force ? run(yes, yes, block, span) : run(yes, no, block, span)
                    : span.force ? run(no, yes, block, span)
                                 : run(no, no, block, span);
  block.started = true;
  return good;
}

}  // namespace punctura::batch
