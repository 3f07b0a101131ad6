// A friction band whose edges are quadratic in depth between breaks. Both solvers compute with it.
#pragma once

#include <array>
#include <cstddef>

#include "punctura/model/lane.hpp"

namespace punctura {

/// The band of friction forces at one depth: [Phi_I, Phi_O], N. K06 (12), (16).
///
/// The needle can rest at any force in the band. A negative force pushes the needle out.
template <typename Scalar>
struct Band {
  Scalar lower;  ///< Phi_I, N: kinetic friction while the needle moves in
  Scalar upper;  ///< Phi_O, N: kinetic friction while the needle moves out

  /// Clamps f (N) to the band, K06 (32).
  constexpr Scalar clamp(Scalar f) const noexcept {
    using namespace lane;
    return min(max(f, lower), upper);
  }
};

template <typename M, Lanes V>
constexpr Band<V> select(const M& mask, const Band<V>& a, const Band<V>& b) noexcept {
  return {select(mask, a.lower, b.lower), select(mask, a.upper, b.upper)};
}

/// One edge of a piece: c0 + c1 x + c2 x^2, N. x is the depth behind the origin of the piece, m.
template <typename Scalar>
struct Quadratic {
  Scalar c0{}, c1{}, c2{};

  constexpr Scalar value(Scalar x) const noexcept { return c0 + x * (c1 + x * c2); }
  constexpr Scalar slope(Scalar x) const noexcept { return c1 + 2 * c2 * x; }
  /// The same function of x - by.
  constexpr Quadratic from(Scalar by) const noexcept { return {value(by), slope(by), c2}; }
  /// This - part * other.
  constexpr Quadratic minus(Scalar part, const Quadratic& other) const noexcept {
    return {c0 - part * other.c0, c1 - part * other.c1, c2 - part * other.c2};
  }
};

/// Both edges of the band between two breaks.
template <typename Scalar>
struct BandPiece {
  Scalar origin{};                     ///< depth where x = 0, m
  Quadratic<Scalar> lower{}, upper{};  ///< Phi_I and Phi_O on this piece

  constexpr Band<Scalar> band(Scalar q) const noexcept {
    const Scalar x = q - origin;
    return {lower.value(x), upper.value(x)};
  }
  /// The same with another origin (m).
  constexpr BandPiece from(Scalar other) const noexcept {
    return {other, lower.from(other - origin), upper.from(other - origin)};
  }
  void describe(auto& parameters) const {
    parameters.fields(origin, lower.c0, lower.c1, lower.c2, upper.c0, upper.c1, upper.c2);
  }
};

template <typename M, Lanes V>
constexpr Quadratic<V> select(const M& mask, const Quadratic<V>& a, const Quadratic<V>& b) noexcept {
  return {select(mask, a.c0, b.c0), select(mask, a.c1, b.c1), select(mask, a.c2, b.c2)};
}
template <typename M, Lanes V>
constexpr BandPiece<V> select(const M& mask, const BandPiece<V>& a, const BandPiece<V>& b) noexcept {
  return {select(mask, a.origin, b.origin), select(mask, a.lower, b.lower), select(mask, a.upper, b.upper)};
}

/// A band of N pieces with N-1 breaks (m) in ascending order.
///
/// The first break, the surface, belongs to the piece behind it. Every other break belongs to the piece in front of it.
/// The closed interval [0, X] of K06 (13) requires this.
template <typename Scalar_, std::size_t N>
struct PiecewiseBand {
  using Scalar = Scalar_;
  static constexpr std::size_t size = N;

  using Piece = BandPiece<Scalar>;

  std::array<Scalar, N - 1> breaks{};
  std::array<Piece, N> pieces{};

  void describe(auto& parameters) const {
    for (const Scalar at : breaks) parameters.fields(at);
    for (const Piece& piece : pieces) piece.describe(parameters);
  }

  /// Index of the piece that contains depth q (m).
  ///
  /// The needle stays in a piece for many ticks, so the processor predicts the branches. Code without branches, which
  /// counts the breaks in front of q, was slower: a tick of the paper's solver on a line took 30 % longer.
  constexpr std::size_t index(Scalar q) const noexcept {
    if (!(q >= breaks[0])) return 0;
    std::size_t i = 1;
    while (i < N - 1 && q > breaks[i]) ++i;
    return i;
  }

  /// Whether depth q (m) is behind break k, in piece k + 1 or a later piece.
  constexpr auto behind(std::size_t k, Scalar q) const noexcept { return k == 0 ? q >= breaks[0] : q > breaks[k]; }

  /// The band at depth q (m), N.
  constexpr Band<Scalar> band(Scalar q) const noexcept {
    if constexpr (OneNumber<Scalar>) {
      return band(q, index(q));
    } else {  // a SIMD type cannot be an index: each lane selects the last piece that it has reached
      Piece piece = pieces[0];
      for (std::size_t k = 0; k < N - 1; ++k) piece = select(behind(k, q), pieces[k + 1], piece);
      return piece.band(q);
    }
  }

  /// The band at depth q (m), N, if piece i contains q.
  constexpr Band<Scalar> band(Scalar q, std::size_t i) const noexcept { return pieces[i].band(q); }

  constexpr const Piece& piece(std::size_t i) const noexcept { return pieces[i]; }
  constexpr const Scalar& end(std::size_t i) const noexcept { return breaks[i]; }  ///< of piece i, m
  static constexpr std::size_t last() noexcept { return N - 1; }                   ///< index of the last piece
};

}  // namespace punctura
