// A law given by a profile: the average of the profile over the path through the wall.
#pragma once

#include <cstddef>
#include <span>

#include "punctura/model/lane.hpp"
#include "punctura/model/law.hpp"
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

namespace punctura {

/// Phi(q) = 1/H * integral of the profile from q - U to q, N, with U = H / cos(beta), K06 (16). It is piecewise
/// quadratic, with breaks at every knot and at every knot + U, so both solvers are exact.
///
/// H = 0 gives the profile / cos(beta). The profile must have passed check_profile().
template <typename Scalar_, std::size_t Most = max_knots>
class BasicProfileLaw {
 public:
  using Scalar = Scalar_;
  using Pieces = ManyPieces<Scalar, 2 * Most + 1>;

  /// thickness: H, m. cos_beta: n.b, for pieces() and band().
  constexpr BasicProfileLaw(const BasicProfile<Scalar, Most>& profile, Scalar thickness,
                            Scalar cos_beta = Scalar(1)) noexcept
      : profile_(profile), H_(thickness), pieces_(pieces(cos_beta)) {}

  /// The pieces for a needle that enters with n.b = cos_beta > 0.
  constexpr Pieces pieces(Scalar cos_beta) const noexcept {
    Pieces all;
    detail::average(profile_, H_, cos_beta, all);
    return all;
  }
  constexpr const Pieces& pieces() const noexcept { return pieces_; }
  constexpr Band<Scalar> band(Scalar q) const noexcept {
    return pieces_.band(q);
  }  ///< at depth q (m, along the needle), N
  constexpr const BasicProfile<Scalar, Most>& profile() const noexcept { return profile_; }
  constexpr Scalar thickness() const noexcept { return H_; }  ///< H, m

 private:
  BasicProfile<Scalar, Most> profile_;
  Scalar H_;
  Pieces pieces_;
};
template <typename Scalar, std::size_t Most>
inline constexpr bool is_proven<BasicProfileLaw<Scalar, Most>> = true;
using ProfileLaw = BasicProfileLaw<double>;
static_assert(ObliqueLaw<ProfileLaw>);

/// Writes the weights w_i of the knots at depth q (m): Phi(q) = sum of phi(knot i) w_i. K06 (16) with a hat function
/// per knot.
///
/// depths: of the knots, m, as in a profile. H: thickness, m. weights: one for each knot. While the needle slides in at
/// known depths, the force is so linear in the knots' values.
template <typename Scalar>
constexpr void profile_weights(std::span<const Scalar> depths, const Scalar& H, const Scalar& cos_beta, const Scalar& q,
                               std::span<Scalar> weights) noexcept {
  using namespace lane;
  const std::size_t n = depths.size();
  for (Scalar& w : weights) w = Scalar(0);
  if (H == 0) {  // the hats themselves
    if (!(q >= depths[0])) return;
    std::size_t i = 1;
    while (i < n && q > depths[i]) ++i;
    const Scalar t = i < n ? (q - depths[i - 1]) / (depths[i] - depths[i - 1]) : Scalar(0);
    weights[i - 1] = (1 - t) / cos_beta;
    if (i < n) weights[i] = t / cos_beta;
    return;
  }
  const Scalar from = q - H / cos_beta;
  for (std::size_t i = 0; i < n; ++i) {  // the part of the path on the line behind knot i
    const Scalar a = max(from, depths[i]), b = i + 1 < n ? min(q, depths[i + 1]) : q;
    if (!(a < b)) continue;
    const Scalar t = i + 1 < n ? ((a - depths[i]) + (b - depths[i])) / (2 * (depths[i + 1] - depths[i])) : Scalar(0);
    weights[i] += (1 - t) * (b - a) / H;
    if (i + 1 < n) weights[i + 1] += t * (b - a) / H;
  }
}

}  // namespace punctura
