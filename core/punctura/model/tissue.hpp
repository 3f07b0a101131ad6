// What measured tissue adds to K06's membrane. Each addition at its default is K06.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "punctura/model/field.hpp"
#include "punctura/model/profile.hpp"
#include "punctura/model/validity.hpp"

namespace punctura {

/// How the wall's force on the needle, the grip G, grows with the opening y of the hole.
enum class GripShape : std::uint8_t {
  linear,       ///< G = kappa y + c: K06
  exponential,  ///< G = c + kappa (exp(growth y) - 1) / growth
  table,        ///< straight lines between the points of grip_table, constant outside them
};

template <>
inline constexpr std::array<std::string_view, 3> words_of<GripShape>{"linear", "exponential", "table"};

/// One point of a measured grip.
template <typename Scalar>
struct BasicGripPoint {
  Scalar opening = Scalar(not_given);  ///< y, m
  Scalar grip = Scalar(not_given);     ///< G, N
};
using GripPoint = BasicGripPoint<double>;

// clang-format off
inline constexpr FieldOf<GripPoint> grip_point_fields[] = {
    {{"opening", "y", "m", {0, 1},
      "Openings of the hole, ascending.", in_unit("mm"), {}, "Grip table, openings"}, &GripPoint::opening},
    {{"grip", "G", "N", {0, 1e6, false, false, ": a wall cannot pull the needle in"},
      "The grip at each opening.", in_unit("N"), {}, "Grip table, forces", "force"}, &GripPoint::grip},
};
// clang-format on
template <>
inline constexpr const auto& columns_of<GripPoint> = grip_point_fields;

/// What a membrane of measured tissue has beside the four numbers of K06. Tissue{} is K06's membrane.
///
/// docs/measured-tissue.md derives the law.
template <typename Scalar>
struct BasicTissue {
  GripShape grip = GripShape::linear;
  Scalar growth{};                                 ///< 1/m, for GripShape::exponential; 0 is linear
  std::vector<BasicGripPoint<Scalar>> grip_table;  ///< for GripShape::table, openings in ascending order
  Scalar tip_length{};                             ///< X, m; 0 is w / tan(theta)
  Scalar tail_length{};                            ///< m: on this length behind X the shaft's friction falls
  Scalar tail_floor{1};                            ///< the part of the shaft's friction that is left behind the tail
  Scalar cutting{};                                ///< N: the tip's force while it cuts the wall for the first time
  Scalar set{};                                    ///< the part of the grip that a hole has lost, 0 to 1
  std::vector<BasicKnot<Scalar>> profile;          ///< not empty: a measured profile in place of grip and tail
};
using Tissue = BasicTissue<double>;

/// Whether grip, tip and shaft are those of K06.
template <typename Scalar>
constexpr bool has_k06_grip(const BasicTissue<Scalar>& t) noexcept {
  const bool straight = t.grip == GripShape::linear || (t.grip == GripShape::exponential && t.growth == 0);
  return straight && t.tip_length == 0 && t.tail_floor == 1 && t.profile.empty();
}

/// Whether a needle changes the membrane.
template <typename Scalar>
constexpr bool remembers(const BasicTissue<Scalar>& t) noexcept {
  return t.cutting > 0 || t.set > 0;
}

/// Whether this is K06's membrane: all additions are off.
template <typename Scalar>
constexpr bool is_k06(const BasicTissue<Scalar>& t) noexcept {
  return has_k06_grip(t) && !remembers(t);
}

// In the order of the struct, of files and of forms.
// clang-format off
template <typename Scalar, typename T = BasicTissue<Scalar>>
inline constexpr auto tissue_rows_of = std::tuple{
    FieldOf<T, GripShape>{{"grip", "", "", {},
      "How the wall's grip on the needle grows with the opening of the hole: linear is K06, exponential grows "
      "faster, table is measured."}, &T::grip},
    FieldOf<T, Scalar>{{"growth", "b", "1/m", {},
      "Of an exponential grip; 0 is linear.", in_unit("per_mm")}, &T::growth},
    FieldOf<T, std::vector<BasicGripPoint<Scalar>>>{{"grip_table", "G", "", {},
      "Of a measured grip: openings (m) and grips (N).", {}, {}, {}, "grip"}, &T::grip_table},
    FieldOf<T, Scalar>{{"tip_length", "X", "m", {0, no_bound, false, true, "", "w / tan theta"},
      "Length of the tip along the needle; 0 is diameter / tan(tip angle).", in_unit("mm")}, &T::tip_length},
    FieldOf<T, Scalar>{{"tail_length", "", "m", at_least_0,
      "The shaft's friction falls on this length behind the tip.", in_unit("mm")}, &T::tail_length},
    FieldOf<T, Scalar>{{"tail_floor", "", "-", {0, 1},
      "The part of the shaft's friction that is left behind the tail; 1 is no tail."}, &T::tail_floor},
    FieldOf<T, Scalar>{{"cutting", "C", "N", {0, no_bound, false, true, ": cutting takes work"},
      "Force on the tip while it cuts the wall for the first time; none on a later pass.", in_unit("N")},
      &T::cutting},
    FieldOf<T, Scalar>{{"set", "", "-", {0, 1},
      "The part of the grip that a hole has lost once the needle has left it."}, &T::set},
    FieldOf<T, std::vector<BasicKnot<Scalar>>>{{"profile", "", "", {},
      "A measured profile: depths (m), lower and upper forces of an infinitely thin wall (N)."}, &T::profile},
};
// clang-format on
inline constexpr auto& tissue_rows = tissue_rows_of<double>;
inline constexpr auto tissue_fields = numbers_of(tissue_rows);

/// The largest number of points of a measured grip: the profile also needs the surface, both sides of
/// the tip's end, and the end of the tail.
inline constexpr std::size_t most_grip_points = max_knots - 4;

namespace detail {
inline void check_grip_table(const std::vector<GripPoint>& table, const std::string& path,
                             std::vector<Problem>& problems) {
  if (table.empty() || table.size() > most_grip_points)
    problems.push_back(
        {path, static_cast<double>(table.size()), "must have 1 to " + std::to_string(most_grip_points) + " points"});
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double opening = table[i].opening;
    const std::string point = path + "[" + std::to_string(i) + "]";
    check_fields(grip_point_fields, table[i], point, problems);
    if (i > 0 && !(opening - table[i - 1].opening >= 1e-9))
      problems.push_back({point + ".opening", opening, "must be greater than the one before it, by 1e-9 m or more"});
  }
}
}  // namespace detail

/// Adds a problem for each value that is outside its range. Returns true if there is none.
///
/// check_curve() (tissue_law.hpp) also needs the needle and the membrane: whether the chords follow the curve.
inline bool check(const Tissue& tissue, const std::string& path, std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  const std::string dot = path.empty() ? "" : path + ".";
  check_fields(tissue_fields, tissue, path, problems);
  if (tissue.grip == GripShape::table) detail::check_grip_table(tissue.grip_table, dot + "grip_table", problems);
  if (!tissue.profile.empty()) check_profile(tissue.profile, dot + "profile", problems);
  return problems.size() == before;
}

}  // namespace punctura
