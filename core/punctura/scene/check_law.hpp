// What is wrong with the law of an untouched membrane, in words.
#pragma once

#include <string>
#include <vector>

#include "punctura/model/law_flaw.hpp"
#include "punctura/model/validity.hpp"

namespace punctura {

/// A flaw of a law as a sentence; empty without one.
inline std::string words_for(const LawFlaw& flaw) {
  if (flaw.kind == LawFlaw::Kind::none) return {};
  const std::string depth = decimal_text(flaw.depth) + " m", lower = decimal_text(flaw.lower) + " N";
  switch (flaw.kind) {
    case LawFlaw::Kind::none: break;
    case LawFlaw::Kind::in_front:
      if (flaw.lower != flaw.lower)
        return "its band is not a number in front of the first break, as where a ManyPieces has too many pieces";
      return "its band must be 0 in front of the first break";
    case LawFlaw::Kind::behind: return "its edges must be constant behind the last finite break";
    case LawFlaw::Kind::order: return "its break " + std::to_string(flaw.at) + " must be at " + depth + " or deeper";
    case LawFlaw::Kind::band:
      return "its band at the depth " + depth + " is from " + lower + " to " + decimal_text(flaw.upper) +
             " N; the lower edge must not be above the upper one, and both must be finite";
    case LawFlaw::Kind::pulls:
      return "its lower edge at the depth " + depth + " is " + lower +
             "; it must be 0 N or less: above, it pulls the needle in";
  }
  return {};
}

/// Adds a problem if the pieces of a law have a flaw. path: of the membrane. only_finite: see find_flaw().
template <typename Pieces>
void check_law(const Pieces& pieces, const std::string& path, std::vector<Problem>& problems,
               bool only_finite = false) {
  if (const std::string flaw = words_for(find_flaw(pieces, only_finite)); !flaw.empty())
    problems.push_back({path, not_given, "the law: " + flaw});
}

}  // namespace punctura
