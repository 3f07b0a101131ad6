// The average of a profile over the path through a wall, as quadratic pieces.
#pragma once

#include <cstddef>

#include "punctura/model/lane.hpp"
#include "punctura/model/many_pieces.hpp"
#include "punctura/model/profile.hpp"

namespace punctura::detail {

/// The straight lines of a profile between its knots.
template <typename Scalar, std::size_t Most>
class Segments {
 public:
  constexpr explicit Segments(const BasicProfile<Scalar, Most>& profile) noexcept : profile_(profile) {}

  /// The number of the segment behind segment i (0 is in front of the first knot). Both knots of a jump count as one.
  constexpr std::size_t next(std::size_t i) const noexcept {
    while (++i < profile_.count && !(start(i) < start(i + 1))) {
    }
    return i;
  }
  constexpr bool more(std::size_t i) const noexcept { return i < profile_.count; }
  /// Where segment i > 0 begins, m.
  constexpr const Scalar& start(std::size_t i) const noexcept { return profile_.knots[i - 1].depth; }

  /// Both edges on segment i as functions of x = q - from, m.
  constexpr BandPiece<Scalar> line(std::size_t i, const Scalar& from) const noexcept {
    if (i == 0) return {from, {}, {}};
    const auto& a = profile_.knots[i - 1];
    if (i == profile_.count) return {from, {a.lower, Scalar(0), Scalar(0)}, {a.upper, Scalar(0), Scalar(0)}};
    const auto& b = profile_.knots[i];
    const Scalar width = b.depth - a.depth, x = from - a.depth;
    const Scalar lower = (b.lower - a.lower) / width, upper = (b.upper - a.upper) / width;
    return {from, {a.lower + lower * x, lower, Scalar(0)}, {a.upper + upper * x, upper, Scalar(0)}};
  }

 private:
  const BasicProfile<Scalar, Most>& profile_;
};

/// One edge of the average behind a break: from the lines at the point of the needle and where it came through the
/// near face, and from its value so far. K06 (16) differentiated: Phi' = (phi(q) - phi(q - U)) / H.
template <typename Scalar>
constexpr Quadratic<Scalar> average_of(const Quadratic<Scalar>& front, const Quadratic<Scalar>& back,
                                       const Scalar& value, const Scalar& H) noexcept {
  return {value, (front.c0 - back.c0) / H, (front.c1 - back.c1) / (2 * H)};
}
/// The same where the whole path lies on one line: the average is the line at the middle of the path.
template <typename Scalar>
constexpr Quadratic<Scalar> average_on(const Quadratic<Scalar>& line, const Scalar& U,
                                       const Scalar& U_over_H) noexcept {
  return {(line.c0 - line.c1 * (U / 2)) * U_over_H, line.c1 * U_over_H, Scalar(0)};
}

/// Fills `to` with Phi(q) = 1/H * integral of the profile from q - U to q, K06 (16). H = 0: the profile / cos(beta).
///
/// Breaks are all knots and all knots + U, merged in order. No difference of two primitives is taken: where the path
/// lies on one line the value is exact, between two breaks it is carried on, and the piece is at most U long.
template <typename Scalar, std::size_t Most, typename Pieces>
constexpr void average(const BasicProfile<Scalar, Most>& profile, const Scalar& H, const Scalar& cos_beta,
                       Pieces& to) noexcept {
  const Segments<Scalar, Most> segments(profile);
  const Scalar U_over_H = 1 / cos_beta, U = H / cos_beta;  // K06 (17)
  std::size_t front = 0, back = 0;
  Scalar lower(0), upper(0);  // Phi at the next break
  while (segments.more(back)) {
    const std::size_t next_front = segments.next(front), next_back = segments.next(back);
    Scalar at = segments.start(next_back) + U;
    if (segments.more(front)) {
      const Scalar ahead = segments.start(next_front);
      if (!(at < ahead)) front = next_front;
      if (at > ahead)
        at = ahead;
      else
        back = next_back;
    } else {
      back = next_back;
    }
    if (to.count > 1) {
      const auto& last = to.pieces[to.count - 1];
      const auto band = last.band(at);
      lower = band.lower;
      upper = band.upper;
    }
    const auto ahead = segments.line(front, at);
    if (front == back) {
      to.add(at, {at, average_on(ahead.lower, U, U_over_H), average_on(ahead.upper, U, U_over_H)});
    } else {
      const auto behind = segments.line(back, at - U);
      to.add(at,
             {at, average_of(ahead.lower, behind.lower, lower, H), average_of(ahead.upper, behind.upper, upper, H)});
    }
  }
}

}  // namespace punctura::detail
