// The band of a wall that remembers a hole: three ranges of depth, with a front between each two.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "punctura/model/many_pieces.hpp"

namespace punctura {

/// Depths (m, along the needle) in one wall, in ascending order:
///
/// - up to `made`: a hole that the needle has left. The grip is `kept` times the first one, and nothing is cut.
/// - up to `cut`: the way of this insertion. The first grip, and nothing is cut.
/// - behind `cut`: an untouched wall.
///
/// The base class is the band of the untouched wall. Its lower edge contains the cutting. The pieces that a solver
/// visits are those of the base class, divided at the two fronts. At a front, where the edges jump, the band contains
/// both sides: the proxy can rest there at any force between.
///
/// A front that has gone through the wall is folded into the pieces of the base class: it costs no time any more.
template <typename Scalar_, std::size_t N>
struct TissueBand : ManyPieces<Scalar_, N> {
  using First = ManyPieces<Scalar_, N>;
  using Scalar = Scalar_;
  using Piece = BandPiece<Scalar>;

  struct Front {
    Scalar at{-infinity};   ///< m; -infinity in an untouched wall
    std::size_t piece = 0;  ///< the piece of First that contains it
  };
  struct Cutting {
    Scalar c0{}, c1{};  ///< N and N/m: c0 + c1 x, x from the piece's origin
  };

  std::array<Cutting, N> cutting{};  ///< in the lower edge of each piece of First
  Scalar kept{1};
  Front made{}, cut{};

  Scalar whole{};          ///< the depth at which a hole is finished, m
  bool cut_whole = false;  ///< the pieces of First have no cutting any more
  bool finished = false;   ///< the hole is finished and left: the pieces of First are its pieces

  /// Moves the fronts to these depths (m), 0 <= made_to <= cut_to. They only move on: a healed wall has new pieces.
  void set_fronts(const Scalar& made_to, const Scalar& cut_to) noexcept {
    if (finished) return;
    if (cut_to < whole) {
      move(made, made_to);
      move(cut, cut_to);
      return;
    }
    if (!cut_whole) {
      for (std::size_t k = 0; k < First::count; ++k) {
        drop_cutting(k, First::pieces[k]);
        cutting[k] = {};
      }
      cut_whole = true;
    }
    if (made_to < whole) {
      move(made, made_to);
      cut = made;
    } else {
      for (std::size_t k = 0; k < First::count; ++k) keep(First::pieces[k]);
      made = cut = {};
      finished = true;
    }
  }

  /// Index of the piece that contains depth q (m), for band(q, i), piece(i) and end(i).
  std::size_t index(const Scalar& q) const noexcept {
    return First::index(q) + (q > made.at ? 1u : 0u) + (q > cut.at ? 1u : 0u);
  }
  Band<Scalar> band(const Scalar& q) const noexcept { return band(q, index(q)); }  ///< at depth q (m), N
  Band<Scalar> band(const Scalar& q, std::size_t i) const noexcept {
    if (q >= cut.at + rounding) return First::pieces[i - 2].band(q);  // behind both fronts, in the shortest way
    if (near(q, cut) || near(q, made)) return at_front(q);
    return piece(i).band(q);
  }

  Piece piece(std::size_t i) const noexcept {
    const std::size_t k = in_first(i);
    Piece piece = First::pieces[k];
    if (i > cut.piece + 1) return piece;
    drop_cutting(k, piece);
    if (i <= made.piece) keep(piece);
    return piece;
  }
  /// Where piece i ends, m.
  const Scalar& end(std::size_t i) const noexcept {
    if (i == made.piece) return made.at;
    if (i == cut.piece + 1) return cut.at;
    return First::breaks[in_first(i)];
  }
  std::size_t last() const noexcept { return First::count + 1; }  ///< index of the last piece

  /// Depths around a depth, at which one piece is the band: from `first` to `last`, both with it.
  struct Around {
    Piece piece;
    Scalar first, last;  ///< m
  };
  /// The depths around q (m). At a front it is q alone. Not all depths of the piece need to be in it.
  Around around(const Scalar& q) const noexcept {
    if (near(q, cut) || near(q, made)) {
      const Band<Scalar> band = at_front(q);
      return {{q, {band.lower}, {band.upper}}, q, q};
    }
    const std::size_t i = index(q);
    Scalar first = i == 0 ? Scalar(-infinity) : std::nextafter(end(i - 1), Scalar(infinity));
    Scalar until = i == last() ? Scalar(infinity) : std::nextafter(end(i), Scalar(-infinity));
    for (const Front& front : {made, cut}) {
      if (front.at + rounding <= q) first = std::max(first, Scalar(front.at + rounding));
      if (q <= front.at - rounding) until = std::min(until, Scalar(front.at - rounding));
    }
    return {piece(i), first, until};
  }

  void describe(auto& parameters) const {
    First::describe(parameters);
    for (std::size_t i = 0; i < First::count; ++i) parameters.numbers(cutting[i].c0, cutting[i].c1);
    parameters.numbers(kept);
  }

 private:
  using One = Lane<Scalar>;
  static constexpr One infinity = std::numeric_limits<One>::infinity();
  /// m: a proxy that rests on a front is within this distance of it, after rounding.
  static constexpr One rounding = std::max(One(1e-10), std::numeric_limits<One>::epsilon());

  /// Takes the cutting out of piece k of First.
  void drop_cutting(std::size_t k, Piece& piece) const noexcept {
    piece.lower.c0 += cutting[k].c0;
    piece.lower.c1 += cutting[k].c1;
  }
  void keep(Piece& piece) const noexcept {
    for (Quadratic<Scalar>* edge : {&piece.lower, &piece.upper})
      *edge = {kept * edge->c0, kept * edge->c1, kept * edge->c2};
  }
  void move(Front& front, const Scalar& to) const noexcept {
    if (!(to > 0)) return;
    std::size_t piece = front.piece;  // a front goes on from its last place
    if (piece == 0) piece = First::index(to);
    while (piece + 1 < First::count && to > First::breaks[piece]) ++piece;
    front = {to, piece};
  }
  /// The band between both sides of the fronts at depth q.
  Band<Scalar> at_front(const Scalar& q) const noexcept {
    const std::size_t first = near(q, made) ? made.piece : cut.piece + 1;
    const std::size_t last = near(q, cut) ? cut.piece + 2 : made.piece + 1;
    Band<Scalar> band = piece(first).band(q);
    for (std::size_t i = first + 1; i <= last; ++i) band = hull(band, piece(i).band(q));
    return band;
  }
  static bool near(const Scalar& q, const Front& front) noexcept {
    return q < front.at + rounding && q > front.at - rounding;
  }
  static Band<Scalar> hull(const Band<Scalar>& a, const Band<Scalar>& b) noexcept {
    return {a.lower < b.lower ? a.lower : b.lower, a.upper < b.upper ? b.upper : a.upper};
  }
  /// The number in First of piece i.
  std::size_t in_first(std::size_t i) const noexcept {
    return i - (i > made.piece ? 1u : 0u) - (i > cut.piece + 1 ? 1u : 0u);
  }
};

}  // namespace punctura
