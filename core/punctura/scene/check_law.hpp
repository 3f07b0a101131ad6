// Whether the pieces of a law, a scene's or the user's own, fulfil what Law asks of them, in an untouched membrane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "punctura/model/law.hpp"
#include "punctura/model/validity.hpp"

namespace punctura {

/// What is wrong with the pieces of a law, as a sentence; empty if nothing is. only_finite: of a scene's own law, whose
/// edges cross by rounding alone.
template <typename Pieces>
std::string flaw_of(const Pieces& pieces, bool only_finite = false) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto level = [](const auto& edge) { return edge.c1 == 0 && edge.c2 == 0; };
  std::size_t first = 0;  // TissueLaw keeps a piece for a hole that is finished: it is empty if its end is -infinity
  while (first < pieces.last() && static_cast<double>(pieces.end(first)) == -infinity) ++first;
  const auto& front = pieces.piece(first);
  const auto& back = pieces.piece(pieces.last());
  if (!level(front.lower) || !level(front.upper) || front.lower.c0 != 0 || front.upper.c0 != 0)
    return "its band must be 0 in front of the first break";
  if (!level(back.lower) || !level(back.upper)) return "its edges must be constant behind the last break";
  double from = 0, largest = 0;  // m, N
  for (std::size_t i = first + 1; i <= pieces.last() && std::isfinite(from); ++i) {
    const auto start = static_cast<double>(pieces.end(i - 1));
    if (!(start >= from))
      return "its break " + std::to_string(i - 1) + " must be at " + decimal_text(from) + " m or deeper";
    from = start;
    const auto& piece = pieces.piece(i);
    const double to = i < pieces.last() ? static_cast<double>(pieces.end(i)) : from;
    const auto width = piece.upper.minus(1, piece.lower);
    const auto turn =
        static_cast<double>(piece.origin - width.c1 / (2 * width.c2));  // NaN or infinity if it is straight
    for (const double depth : {from, to, turn > from && turn < to ? turn : from}) {
      if (!std::isfinite(depth)) continue;
      const auto [lower, upper] = piece.band(static_cast<typename Pieces::Scalar>(depth));
      largest = std::max({largest, std::abs(static_cast<double>(lower)), std::abs(static_cast<double>(upper))});
      const auto rounding =
          1e-6 * (std::abs(lower) + std::abs(upper)) + 1e-9 * largest;  // an average rounds to its parts
      if (only_finite && std::isfinite(rounding)) continue;
      if (!std::isfinite(rounding) || lower > upper + rounding)
        return "its band at the depth " + decimal_text(depth) + " m is from " + decimal_text(lower) + " N to " +
               decimal_text(upper) + " N; the lower edge must not be above the upper one, and both must be finite";
      if (lower > rounding)
        return "its lower edge at the depth " + decimal_text(depth) + " m is " + decimal_text(lower) +
               " N; it must be 0 N or less: above, it pulls the needle in";
    }
  }
  return {};
}

/// Adds a problem if the pieces of a law have a flaw. path: of the membrane.
template <typename Pieces>
void check_law(const Pieces& pieces, const std::string& path, std::vector<Problem>& problems,
               bool only_finite = false) {
  if (const std::string flaw = flaw_of(pieces, only_finite); !flaw.empty())
    problems.push_back({path, not_given, "the law: " + flaw});
}

}  // namespace punctura
