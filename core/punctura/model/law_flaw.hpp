// Whether the pieces of a law, a scene's or the user's own, fulfil what Law asks of them.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "punctura/model/law.hpp"

namespace punctura {

/// What is wrong with the pieces of a law, and where.
struct LawFlaw {
  enum class Kind : std::uint8_t {
    none,
    in_front,  ///< the band is not 0 in front of the first break; NaN there: a ManyPieces has too many pieces
    behind,    ///< an edge is not constant behind the last finite break
    order,     ///< break `at` is in front of `depth`, or is not a number
    band,      ///< the lower edge is above the upper one at `depth`, or one is not finite
    pulls,     ///< the lower edge is above 0 N at `depth`
  };
  Kind kind = Kind::none;
  std::size_t at = 0;
  double depth = 0, lower = 0, upper = 0;  ///< m, N, N
};

/// The same flaws, as the fault of a run names them: it cannot say which one it was, nor where.
constexpr const char* flawed_in_run() noexcept {
  return "the model gave a force that is not a number, or its law has a band that is not finite, not 0 in front of the "
         "first break, not constant behind the last one, or whose lower edge is above the upper one or above 0 N, or "
         "it has breaks in front of the surface, out of order or too many: "
         "correct the law if it is your own; otherwise please report the scene and the recording";
}

/// The first flaw. only_finite: of a scene's own law, whose edges cross by rounding alone.
template <typename Pieces>
constexpr LawFlaw find_flaw(const Pieces& pieces, bool only_finite = false) noexcept {
  using lane::abs, lane::finite;
  using Scalar = typename Pieces::Scalar;
  using Kind = LawFlaw::Kind;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double of_parts = std::max(1e-9, 100.0 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
  const auto level = [](const auto& edge) { return edge.c1 == 0 && edge.c2 == 0; };
  std::size_t first = 0;  // TissueLaw keeps a piece for a hole that is finished: it is empty if its end is -infinity
  while (first < pieces.last() && static_cast<double>(pieces.end(first)) == -infinity) ++first;
  const auto& front = pieces.piece(first);
  const auto& back = pieces.piece(pieces.last());
  if (!level(front.lower) || !level(front.upper) || front.lower.c0 != 0 || front.upper.c0 != 0)
    return {Kind::in_front, 0, 0, static_cast<double>(front.lower.c0), static_cast<double>(front.upper.c0)};
  if (!level(back.lower) || !level(back.upper)) return {Kind::behind};
  double from = 0, largest = 0;  // m, N
  for (std::size_t i = first + 1; i <= pieces.last() && finite(from); ++i) {
    const auto start = static_cast<double>(pieces.end(i - 1));
    if (!(start >= from - 1e-12)) return {Kind::order, i - 1, from};
    from = start;
    const auto& piece = pieces.piece(i);
    const double to = i < pieces.last() ? static_cast<double>(pieces.end(i)) : from;
    if (to == infinity && finite(from) && !(level(piece.lower) && level(piece.upper))) return {Kind::behind};
    const auto turn = [&](const auto& edge) {  // where it is largest or smallest, m
      if (edge.c2 == 0) return from;
      const auto at = static_cast<double>(piece.origin - edge.c1 / (2 * edge.c2));
      return at > from && at < to ? at : from;
    };
    for (const double depth : {from, to, turn(piece.upper.minus(1, piece.lower)), turn(piece.lower)}) {
      if (!finite(depth)) continue;
      const auto [lower, upper] = piece.band(static_cast<Scalar>(depth));
      const LawFlaw found{Kind::band, 0, depth, static_cast<double>(lower), static_cast<double>(upper)};
      largest = std::max({largest, abs(found.lower), abs(found.upper)});
      const double rounding =  // an average rounds to its parts
          1e-6 * (abs(found.lower) + abs(found.upper)) + of_parts * largest;
      if (!finite(rounding)) return found;
      if (only_finite) continue;
      if (found.lower > found.upper + rounding) return found;
      if (found.lower > rounding) return {Kind::pulls, 0, depth, found.lower, found.upper};
    }
  }
  return {};
}

/// Whether a law may break its word in a run: one of the user's own.
template <typename L>
concept MayHaveFlaws = std::floating_point<typename L::Scalar> && !is_proven<L>;

/// Whether pieces of this law have a flaw. A law can answer itself: MixedLaw does.
template <MayHaveFlaws L>
constexpr bool has_flaw(const L& law, const PiecesOf<L>& pieces) noexcept {
  if constexpr (requires { L::has_flaw(law, pieces); })
    return L::has_flaw(law, pieces);
  else
    return find_flaw(pieces).kind != LawFlaw::Kind::none;
}

}  // namespace punctura
