// The permitted values of a needle, of a membrane and of a pair of them. Check them before you construct a law.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "punctura/model/decimal.hpp"
#include "punctura/model/field.hpp"
#include "punctura/model/membrane.hpp"

namespace punctura {

/// A value that is not allowed, with the reason.
struct Problem {
  std::string path;    ///< field, as in "membrane[1].friction"
  double value;        ///< the given value, SI
  std::string reason;  ///< the bound that the value breaks, and the reason for the bound
};

/// "membrane[1].friction = 7: must be ...", without the number if the value is NaN.
inline std::string line_of(const Problem& p) {
  return p.path + (std::isnan(p.value) ? "" : " = " + decimal_text(p.value)) + ": " + p.reason;
}

/// The sentence of a field's bounds: "must be from 100 to 100000 Hz: below, forces step; above, no device follows".
inline std::string bound_text(const Field& field) {
  const Range& r = field.range;
  const bool below = r.min != -no_bound, above = r.max != no_bound;
  const auto text = [&](double bound, bool unit) {
    return (bound == std::numbers::pi / 2 ? "pi/2" : decimal_text(bound, 6)) +
           (unit && field.unit != "-" ? " " + std::string(field.unit) : "");
  };
  const std::string meaning = *r.at_min ? " (" + std::string(r.at_min) + ")" : "";
  const std::string low = text(r.min, !above && r.min != 0) + meaning, high = text(r.max, true);
  std::string all = "must be ";
  if (!below && !above)
    all += "a finite number";
  else if (!above)
    all += r.min_open ? "greater than " + low : low + " or more";
  else if (!below)
    all += r.max_open ? "less than " + high : high + " or less";
  else if (r.min_open)
    all += (r.max_open ? "between " + low + " and " : "greater than " + low + " and at most ") + high;
  else
    all += "from " + low + (r.max_open ? " to below " : " to ") + high;
  return all + r.why;
}

// clang-format off
inline constexpr FieldOf<Needle> needle_fields[] = {
    {{"diameter", "w", "m", greater_than_0,
      "Outer diameter of the shaft.", in_unit("mm"), {1e-5, 0.05}}, &Needle::diameter},
    {{"tip_angle", "theta", "rad",
      {0, std::numbers::pi / 2, true, true, ": a blunt needle does not enter, K06 (7)"},
      "Angle between the slanted face and the axis.", in_unit("rad")}, &Needle::tip_angle},
};

inline constexpr FieldOf<Membrane> membrane_fields[] = {
    {{"stiffness", "kappa", "N/m", {0, no_bound, true, true, ", K06 (15)"},
      "Resistance of the hole to widening.", in_unit("N_per_mm"), {1, 1e5}}, &Membrane::stiffness},
    {{"precompression", "c", "N",
      {0, no_bound, false, true, ": a membrane cannot pull the needle in"},
      "Grip of the hole when it is closed.", in_unit("N"), {1e-4, 100}}, &Membrane::precompression},
    {{"friction", "mu", "-",
      {0, no_bound, true, true, ": without friction nothing holds the needle, K06 (20)"},
      "Coefficient of dry friction between needle and membrane."}, &Membrane::friction},
    {{"thickness", "H", "m", {0, no_bound, false, true, "", "the thin law"},
      "0 is an infinitely thin membrane.", in_unit("mm"), {1e-6, 0.1}}, &Membrane::thickness},
};
// clang-format on

/// The angle between the needle and the membrane's inward normal. K06 Fig. 4.
inline constexpr Field obliquity_field = {
    "obliquity", "beta", "rad", {0, std::numbers::pi / 2, false, true, ", K06 (17)"}};

/// Adds a problem if v (SI) is outside the field's range. Returns true if v is inside.
inline bool check_field(const Field& field, double v, const std::string& path, std::vector<Problem>& problems) {
  if (field.range.holds(v)) return true;
  const std::string dot = path.empty() ? "" : ".";
  problems.push_back(
      {path + dot + std::string(field.name), v, std::isfinite(v) ? bound_text(field) : "must be a finite number"});
  return false;
}

/// Adds a problem for each field of `owner` that is outside its range. Returns true if there is no such field.
template <typename Fields, typename Owner>
bool check_fields(const Fields& fields, const Owner& owner, const std::string& path, std::vector<Problem>& problems) {
  bool good = true;
  for (const auto& field : fields) good &= check_field(field, owner.*field.member, path, problems);
  return good;
}

inline bool check(const Needle& needle, const std::string& path, std::vector<Problem>& problems) {
  return check_fields(needle_fields, needle, path, problems);
}

inline bool check(const Membrane& membrane, const std::string& path, std::vector<Problem>& problems) {
  return check_fields(membrane_fields, membrane, path, problems);
}

/// The largest friction, rounded down to four digits, with which a needle enters: mu tan(theta) < 1, K06 (7).
inline double largest_friction(double tip_angle) {
  const double bound = 1 / std::tan(tip_angle), digit = std::pow(10, std::floor(std::log10(bound)) - 3);
  const double rounded = std::floor(bound / digit) * digit;
  return rounded * std::tan(tip_angle) < 1 ? rounded : rounded - digit;
}

/// Adds a problem if mu tan(theta) >= 1: insertion is then impossible, K06 (7). Returns true if mu tan(theta) < 1.
///
/// The tip angle and the friction must be inside their ranges.
inline bool check_insertion(const Needle& needle, const Membrane& membrane, const std::string& membrane_path,
                            std::vector<Problem>& problems) {
  if (membrane.friction * std::tan(needle.tip_angle) < 1) return true;
  const std::string dot = membrane_path.empty() ? "" : ".";
  problems.push_back({membrane_path + dot + "friction", membrane.friction,
                      "the largest value that is allowed with this tip angle is " +
                          decimal_text(largest_friction(needle.tip_angle), 4) + ", K06 (7)"});
  return false;
}

}  // namespace punctura
