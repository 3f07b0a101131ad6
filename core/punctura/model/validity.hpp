// What a needle, a membrane and their pair must fulfil before a law may be built of them.
#pragma once

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/model/membrane.hpp"
#include "punctura/model/needle.hpp"

namespace punctura {

/// One thing that is wrong with a configuration. `value` is in SI units.
struct Problem {
  std::string path;    ///< field, as in "membrane[1].friction"
  double value;        ///< what was given
  std::string reason;  ///< the bound that it breaks, and why that bound is there
};

/// The admissible range of one field, SI. The one place where bounds stand; schemas and documents read them here.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false, max_open = false;
  const char* reason = "must be a finite number";

  bool holds(double v) const noexcept {
    return std::isfinite(v) && (min_open ? v > min : v >= min) && (max_open ? v < max : v <= max);
  }
};

/// A field with its range: the name that stands in the struct, the symbol of K06, the unit.
struct Field {
  std::string_view name, symbol, unit;
  Range range;
};

inline constexpr double no_bound = std::numeric_limits<double>::infinity();

inline constexpr Field needle_fields[] = {
    {"diameter", "w", "m", {0, no_bound, true, true, "must be greater than 0"}},
    {"tip_angle",
     "theta",
     "rad",
     {0, std::numbers::pi / 2, true, true, "must be between 0 and pi/2: a blunt needle does not enter, K06 (7)"}},
};

inline constexpr Field membrane_fields[] = {
    {"stiffness",
     "kappa",
     "N/m",
     {0, no_bound, true, true, "must be greater than 0: Q = c/(kappa tan(theta)), K06 (15)"}},
    {"precompression", "c", "N", {0, no_bound, false, true, "must be 0 or more: a membrane cannot pull the needle in"}},
    {"friction",
     "mu",
     "-",
     {0, no_bound, true, true, "must be greater than 0: without friction nothing holds the needle, K06 (20)"}},
    {"thickness", "H", "m", {0, no_bound, false, true, "must be 0 (the thin law) or more"}},
};

/// The angle between the needle and the membrane's inward normal. K06 Fig. 4.
inline constexpr Field obliquity_field = {
    "obliquity",
    "beta",
    "rad",
    {0, std::numbers::pi / 2, false, true, "must be 0 or more and less than pi/2, K06 (17)"}};

/// Adds a problem where v is outside the field's range. Returns whether it is inside.
inline bool check_field(const Field& field, double v, const std::string& path, std::vector<Problem>& problems) {
  if (field.range.holds(v)) return true;
  const std::string dot = path.empty() ? "" : ".";
  problems.push_back(
      {path + dot + std::string(field.name), v, std::isfinite(v) ? field.range.reason : "must be a finite number"});
  return false;
}

inline bool check(const Needle& needle, const std::string& path, std::vector<Problem>& problems) {
  const bool diameter = check_field(needle_fields[0], needle.diameter, path, problems);
  const bool tip_angle = check_field(needle_fields[1], needle.tip_angle, path, problems);
  return diameter && tip_angle;
}

inline bool check(const Membrane& membrane, const std::string& path, std::vector<Problem>& problems) {
  const double values[] = {membrane.stiffness, membrane.precompression, membrane.friction, membrane.thickness};
  bool good = true;
  for (std::size_t i = 0; i < 4; ++i) good &= check_field(membrane_fields[i], values[i], path, problems);
  return good;
}

/// K06 (7): insertion is possible at all only where mu tan(theta) < 1. Call it with a sound needle and membrane.
inline bool check_insertion(const Needle& needle, const Membrane& membrane, const std::string& membrane_path,
                            std::vector<Problem>& problems) {
  const double mu_tan = membrane.friction * std::tan(needle.tip_angle);
  if (mu_tan < 1) return true;
  char text[96];
  std::snprintf(text, sizeof text, "insertion needs mu tan(theta) < 1, K06 (7); here %.4g", mu_tan);
  const std::string dot = membrane_path.empty() ? "" : ".";
  problems.push_back({membrane_path + dot + "friction", membrane.friction, text});
  return false;
}

}  // namespace punctura
