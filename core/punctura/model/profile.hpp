// A profile: the force of an infinitely thin wall against depth, with straight lines between knots.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/model/validity.hpp"

namespace punctura {

inline constexpr std::size_t max_knots = 32;

template <typename Scalar>
struct BasicKnot {
  Scalar depth = Scalar(not_given);  ///< m, along the needle
  Scalar lower = Scalar(not_given);  ///< phi_I there, N, 0 or less
  Scalar upper = Scalar(not_given);  ///< phi_O there, N
};
using Knot = BasicKnot<double>;

// clang-format off
inline constexpr FieldOf<Knot> knot_fields[] = {
    {{"depth", "q", "m", {0, 1e6},
      "A measured profile of an infinitely thin wall, in place of grip and tail: depths of its knots.",
      in_unit("mm"), {}, "Profile, depths"}, &Knot::depth},
    {{"lower", "phi_I", "N", {-1e6, 0, false, false, ": the lower edge resists insertion"},
      "The force on the way in at each knot, 0 or less.", in_unit("N"), {}, "Profile, lower"}, &Knot::lower},
    {{"upper", "phi_O", "N", {-1e6, 1e6},
      "The force on the way out at each knot.", in_unit("N"), {}, "Profile, upper"}, &Knot::upper},
};
// clang-format on
template <>
inline constexpr const auto& columns_of<Knot> = knot_fields;

/// phi_I and phi_O of a thin wall, N: straight lines between knots in ascending order.
///
/// The force is 0 before the first knot and constant behind the last one. It may jump at the first knot. Two knots at
/// one depth are a jump there; the first of them holds at this depth. K06 (13), (14) is such a profile: 0, X and X.
template <typename Scalar, std::size_t Most = max_knots>
struct BasicProfile {
  std::array<BasicKnot<Scalar>, Most> knots{};
  std::size_t count = 0;

  BasicProfile() = default;
  /// The first `Most` of these knots.
  constexpr explicit BasicProfile(std::span<const BasicKnot<Scalar>> from) noexcept {
    for (const auto& knot : from) add(knot.depth, knot.lower, knot.upper);
  }

  /// Adds a knot. A full profile does not change.
  constexpr void add(const Scalar& depth, const Scalar& lower, const Scalar& upper) noexcept {
    if (count < Most) knots[count++] = {depth, lower, upper};
  }
  constexpr std::span<const BasicKnot<Scalar>> used() const noexcept { return {knots.data(), count}; }
};
using Profile = BasicProfile<double>;

/// Adds every reason why these knots are no profile. Returns true if there is none.
///
/// path: of the profile. path_of(i, field): of one number of knot i.
template <typename PathOf>
bool check_profile(std::span<const Knot> knots, const std::string& path, PathOf&& path_of,
                   std::vector<Problem>& problems) {
  const std::size_t before = problems.size(), n = knots.size();
  if (n == 0 || n > max_knots)
    problems.push_back({path, static_cast<double>(n), "must have 1 to " + std::to_string(max_knots) + " knots"});
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [depth, lower, upper] = knots[i];
    const auto add = [&](std::string_view field, double value, const std::string& reason) {
      problems.push_back({path_of(i, std::string(field)), value, reason});
    };
    for (const auto& field : knot_fields)
      if (!field.range.holds(knots[i].*field.member)) add(field.name, knots[i].*field.member, bound_text(field));
    if (i == 1 && depth == knots[0].depth) add("depth", depth, "must be greater than the depth of the first knot");
    if (i > 0 && depth != knots[i - 1].depth && !(depth - knots[i - 1].depth >= 1e-9))
      add("depth", depth, "must be the depth of the knot before it, for a jump, or greater by 1e-9 m or more");
    if (i > 1 && depth == knots[i - 1].depth && depth == knots[i - 2].depth)
      add("depth", depth, "must not be the depth of both knots before it: at most two knots make a jump");
    if (lower > upper) add("lower", lower, "must not be greater than upper at the same knot");
  }
  return problems.size() == before;
}
/// The same for a list of knots: the paths are path[i].depth, path[i].lower and path[i].upper.
inline bool check_profile(std::span<const Knot> knots, const std::string& path, std::vector<Problem>& problems) {
  const auto path_of = [&](std::size_t i, const std::string& field) {
    return path + "[" + std::to_string(i) + "]." + field;
  };
  return check_profile(knots, path, path_of, problems);
}

}  // namespace punctura
