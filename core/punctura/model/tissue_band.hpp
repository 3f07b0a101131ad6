// The band of a wall that remembers a hole: what is a hole, what this insertion has cut, and what is untouched.
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
/// - up to `made`: holes that the needle has left. The grip is `kept` times the first one, and nothing is cut.
/// - up to `cut`: the way of this insertion. Nothing is cut. The slices of the wall that a tip had passed when it left
///   keep `kept` of their grip, the others have the first grip.
/// - behind `cut`: the same, and the tip cuts.
///
/// The pieces of the base class are those of the wall with its holes, with a break at `made`. Their lower edges contain
/// the cutting. The pieces that a solver visits are the same, divided at the front `cut`. At `made` and at `cut`, where
/// the edges jump, the band contains both sides: the proxy can rest there at any force between.
///
/// Only `cut` moves during an insertion. When the tip has left, the wall has new pieces.
template <typename Scalar_, std::size_t N>
struct TissueBand : ManyPieces<Scalar_, N> {
  using First = ManyPieces<Scalar_, N>;
  using Scalar = Scalar_;
  using Piece = BandPiece<Scalar>;

  struct Front {
    Scalar at{-infinity};   ///< m; -infinity: there is none
    std::size_t piece = 0;  ///< the piece of First that contains it
  };
  struct Cutting {
    Scalar c0{}, c1{};  ///< N and N/m: c0 + c1 x, x from the piece's origin
  };

  std::array<Cutting, N> cutting{};  ///< in the lower edge of each piece of First
  bool cuts = false;                 ///< some of them is not 0
  Scalar kept{1};
  Front made{}, cut{};  ///< made.at <= cut.at

  Scalar cos_beta{1};  ///< n.b of the needle that these pieces are for
  Scalar whole{};      ///< the depth at which the whole tip has passed the wall, m
  Scalar hole{};       ///< BasicHole::made of these pieces, m

  /// Takes the grip of a hole up to this depth (m), which is behind the first break. Behind it, subtracts a part of
  /// another band, that of the slices that the tip has passed.
  template <std::size_t M>
  constexpr void open(const Scalar& to, const ManyPieces<Scalar, M>& passed, const Scalar& part) noexcept {
    First::split(to);
    for (std::size_t k = 0; k + 1 < passed.count; ++k)
      if (to < passed.breaks[k]) First::split(passed.breaks[k]);
    keep(First::pieces[0]);
    for (std::size_t i = 1, k = 0; i < First::count; ++i) {
      Piece& piece = First::pieces[i];
      const Scalar& begin = First::breaks[i - 1];
      if (begin < to) {
        keep(piece);
        continue;
      }
      while (k + 1 < passed.count && !(begin < passed.breaks[k])) ++k;
      const Piece now = piece.from(begin), less = passed.pieces[k].from(begin);
      piece = {begin, now.lower.minus(part, less.lower), now.upper.minus(part, less.upper)};
    }
    made.at = to;
  }
  /// Takes the grip of a hole in which the whole tip has passed the wall.
  constexpr void open_whole() noexcept {
    for (std::size_t k = 0; k < First::count; ++k) keep(First::pieces[k]);
  }
  /// Places the fronts, once all pieces are there. to: m, the deepest point that the tip has reached.
  constexpr void set_fronts(const Scalar& to) noexcept {
    if (made.at > 0) made.piece = First::index(made.at);
    cut = made;
    set_cut(to);
  }
  /// The tip has reached this depth (m). It only goes on.
  constexpr void set_cut(const Scalar& to) noexcept {
    if (!cuts) return;
    if (to < whole) {
      move(cut, to);
      return;
    }
    for (std::size_t k = 0; k < First::count; ++k) drop_cutting(k, First::pieces[k]);
    cutting = {};
    cuts = false;
    cut = made;
  }

  /// Index of the piece that contains depth q (m), for band(q, i), piece(i) and end(i).
  constexpr std::size_t index(const Scalar& q) const noexcept { return First::index(q) + (q > cut.at ? 1u : 0u); }
  constexpr Band<Scalar> band(const Scalar& q) const noexcept { return band(q, index(q)); }  ///< at depth q (m), N
  constexpr Band<Scalar> band(const Scalar& q, std::size_t i) const noexcept {
    if (q >= cut.at + rounding) return First::pieces[i - 1].band(q);  // behind both fronts, in the shortest way
    if (near(q, cut) || near(q, made)) return at_front(q);
    return piece(i).band(q);
  }

  constexpr Piece piece(std::size_t i) const noexcept {
    const std::size_t k = in_first(i);
    Piece piece = First::pieces[k];
    if (i <= cut.piece) drop_cutting(k, piece);
    return piece;
  }
  /// Where piece i ends, m.
  constexpr const Scalar& end(std::size_t i) const noexcept {
    return i == cut.piece ? cut.at : First::breaks[in_first(i)];
  }
  constexpr std::size_t last() const noexcept { return First::count; }  ///< index of the last piece

  /// Depths around a depth, at which one piece is the band: from `first` to `last`, both with it.
  struct Around {
    Piece piece;
    Scalar first, last;  ///< m
  };
  /// The depths around q (m). At a front it is q alone. Not all depths of the piece need to be in it.
  constexpr Around around(const Scalar& q) const noexcept {
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
    for (std::size_t i = 0; i < First::count; ++i) parameters.fields(cutting[i].c0, cutting[i].c1);
    parameters.fields(kept);
  }

 private:
  using One = Lane<Scalar>;
  static constexpr One infinity = std::numeric_limits<One>::infinity();
  /// m: a proxy that rests on a front is within this distance of it, after rounding.
  static constexpr One rounding = std::max(One(1e-10), std::numeric_limits<One>::epsilon());

  /// Takes the cutting out of piece k of First.
  constexpr void drop_cutting(std::size_t k, Piece& piece) const noexcept {
    piece.lower.c0 += cutting[k].c0;
    piece.lower.c1 += cutting[k].c1;
  }
  constexpr void keep(Piece& piece) const noexcept {
    for (Quadratic<Scalar>* edge : {&piece.lower, &piece.upper})
      *edge = {kept * edge->c0, kept * edge->c1, kept * edge->c2};
  }
  constexpr void move(Front& front, const Scalar& to) const noexcept {
    if (!(to > 0)) return;
    std::size_t piece = front.piece;  // a front goes on from its last place
    if (piece == 0) piece = First::index(to);
    while (piece + 1 < First::count && to > First::breaks[piece]) ++piece;
    front = {to, piece};
  }
  /// The band between both sides of the fronts at depth q.
  constexpr Band<Scalar> at_front(const Scalar& q) const noexcept {
    const bool hole_ends = near(q, made);
    const std::size_t first = hole_ends ? made.piece : cut.piece;
    std::size_t last = hole_ends ? made.piece + 1 : 0;
    if (near(q, cut))
      last = std::max(last, cut.piece) + 1;  // if both are at one depth, cut divides the piece made.piece
    Band<Scalar> band = piece(first).band(q);
    for (std::size_t i = first + 1; i <= last; ++i) band = hull(band, piece(i).band(q));
    return band;
  }
  static constexpr bool near(const Scalar& q, const Front& front) noexcept {
    return q < front.at + rounding && q > front.at - rounding;
  }
  static constexpr Band<Scalar> hull(const Band<Scalar>& a, const Band<Scalar>& b) noexcept {
    return {a.lower < b.lower ? a.lower : b.lower, a.upper < b.upper ? b.upper : a.upper};
  }
  /// The number in First of piece i.
  constexpr std::size_t in_first(std::size_t i) const noexcept { return i - (i > cut.piece ? 1u : 0u); }
};

}  // namespace punctura
