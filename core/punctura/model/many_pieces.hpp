// A friction band with a number of pieces that is only known at run time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "punctura/model/piecewise_band.hpp"

namespace punctura {

/// A band of at most N pieces. The breaks have the same sides as those of PiecewiseBand.
///
/// With more than N, all pieces are NaN: no force of a part of them would be right. In a run that is a fault, which
/// ends the force in the same tick; a program that aborts would leave a device with its last force.
///
/// It is slower than PiecewiseBand for a handful of pieces and faster for many: the time grows with the pieces in use.
template <typename Scalar_, std::size_t N>
struct ManyPieces {
  using Scalar = Scalar_;
  using Piece = BandPiece<Scalar>;
  static constexpr std::size_t size = N;

  static constexpr std::size_t block = 8;      ///< index() compares with so many breaks at once
  std::array<Scalar, N - 1 + block> breaks{};  ///< m, ascending; infinite where unused
  std::array<Piece, N> pieces{};
  std::size_t count = 1;  ///< pieces in use
  std::size_t here = 0;   ///< index() looks here first

  constexpr ManyPieces() noexcept { breaks.fill(Scalar(std::numeric_limits<Lane<Scalar>>::infinity())); }

  void describe(auto& parameters) const {
    for (std::size_t i = 0; i + 1 < count; ++i) parameters.fields(breaks[i]);
    for (std::size_t i = 0; i < count; ++i) pieces[i].describe(parameters);
  }

  /// Adds a break and the piece behind it. A piece of length 0 is replaced.
  constexpr void add(const Scalar& at, const Piece& behind) noexcept {
    if (count > 1 && !(breaks[count - 2] < at)) --count;
    if (count == N) return spoil();
    breaks[count - 1] = at;
    pieces[count++] = behind;
  }
  /// Divides the piece that contains this depth (m), if it is no break yet.
  constexpr void split(const Scalar& at) noexcept {
    std::size_t i = 0;
    while (i + 1 < count && breaks[i] < at) ++i;
    if (i + 1 < count && !(at < breaks[i])) return;
    if (count == N) return spoil();
    for (std::size_t k = count; k > i; --k) pieces[k] = pieces[k - 1];
    for (std::size_t k = count - 1; k > i; --k) breaks[k] = breaks[k - 1];
    breaks[i] = at;
    ++count;
  }

  /// Index of the piece that contains depth q (m).
  constexpr std::size_t index(const Scalar& q) const noexcept {
    if (!(q >= breaks[0])) return 0;
    if (here > 0 && (here == 1 || q > breaks[here - 1]) && !(q > breaks[here])) return here;
    std::size_t first = 1, left = count - 2;
    while (left > 0) {  // bisection
      const std::size_t half = left / 2;
      const bool behind = q > breaks[first + half];
      first = behind ? first + half + 1 : first;
      left = behind ? left - half - 1 : half;
    }
    return first;
  }
  /// Tells that the next depth will probably be near q (m). This only saves time.
  constexpr void look_at(const Scalar& q) noexcept { here = index(q); }

  constexpr Band<Scalar> band(const Scalar& q) const noexcept { return band(q, index(q)); }  ///< at depth q (m), N
  constexpr Band<Scalar> band(const Scalar& q, std::size_t i) const noexcept { return pieces[i].band(q); }

  constexpr const Piece& piece(std::size_t i) const noexcept { return pieces[i]; }
  constexpr const Scalar& end(std::size_t i) const noexcept { return breaks[i]; }  ///< of piece i, m
  constexpr std::size_t last() const noexcept { return count - 1; }                ///< index of the last piece

 private:
  [[gnu::noinline, gnu::cold]] constexpr void spoil() noexcept {
    const Quadratic<Scalar> none{Scalar(std::numeric_limits<Lane<Scalar>>::quiet_NaN())};
    pieces.fill({Scalar(0), none, none});
  }
};

}  // namespace punctura
