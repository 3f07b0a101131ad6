// The usual sizes of a scene's numbers. A number that is off by a factor of 1,000 is possible, but hardly meant.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/scene/values.hpp"

namespace punctura {

/// A unit of a field; its size in SI.
struct UsualUnit {
  const char* name;
  double size;
};

/// The usual range of a field, SI, and the units in which it is often given, the SI unit first.
struct Usual {
  std::string_view field;
  double low, high;
  UsualUnit units[3];
};

inline constexpr Usual usual_ranges[] = {
    {"needle.diameter", 1e-5, 0.05, {{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}}},
    {"coupling.stiffness", 5, 1e5, {{"N/m", 1}, {"N/mm", 1e3}, {"N/um", 1e6}}},
    {"membrane.stiffness", 1, 1e5, {{"N/m", 1}, {"N/mm", 1e3}, {"N/um", 1e6}}},
    {"membrane.thickness", 1e-6, 0.1, {{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}}},
    {"membrane.precompression", 1e-4, 100, {{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}}},
    {"syringe.bore", 1e-3, 0.1, {{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}}},
    {"syringe.liquid", 1e-8, 3e-4, {{"m^3", 1}, {"mL", 1e-6}, {"L", 1e-3}}},
    {"syringe.air", 1e-9, 3e-4, {{"m^3", 1}, {"mL", 1e-6}, {"L", 1e-3}}},
    {"syringe.friction", 1e-3, 100, {{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}}},
    {"syringe.compliance", 1e-15, 2e-10, {{"m^3/Pa", 1}, {"mL/kPa", 1e-9}, {"mL/Pa", 1e-6}}},
    {"syringe.resistance", 1e7, 1e13, {{"Pa s/m^3", 1}, {"kPa s/mL", 1e9}, {"Pa s/mL", 1e6}}},
    {"syringe.thumb_stiffness", 5, 1e5, {{"N/m", 1}, {"N/mm", 1e3}, {"N/um", 1e6}}},
};

/// The row of a path such as "membrane[0].stiffness"; null if there is none.
inline const Usual* usual_range(std::string path) {
  const std::size_t from = path.find('['), to = path.find(']');
  if (from != std::string::npos && to != std::string::npos && from < to) path.erase(from, to - from + 1);
  for (const Usual& row : usual_ranges)
    if (path == row.field) return &row;
  return nullptr;
}

/// The SI unit of a path in usual_ranges, else "".
inline const char* usual_unit(const std::string& path) {
  const Usual* row = usual_range(path);
  return row ? row->units[0].name : "";
}

/// What to write instead of a number that is off by a factor of 1,000 or 1,000,000; "" if it is not.
///
/// written: the number in a unit of `size` in SI. The answer is in the same unit: "If you meant 570 N/m, write 0.57".
inline std::string unusual(const std::string& path, double written, double size = 1) {
  const Usual* row = usual_range(path);
  const auto found = [&](double v) { return std::abs(v) >= row->low && std::abs(v) <= row->high; };
  if (!row || written == 0 || found(written * size)) return "";
  const std::string number = decimal_text(written, 6);
  for (const UsualUnit& unit : row->units) {
    if (!found(written * unit.size)) continue;
    // The first unit that fits. Rounded: the product of doubles has digits that nobody wrote.
    return "If you meant " + number + " " + unit.name + ", write " + decimal_text(written * unit.size / size, 6);
  }
  for (const double factor : {1e-3, 1e3}) {
    if (!found(written * size * factor)) continue;
    return std::string("If you meant a number 1000 times ") + (factor < 1 ? "smaller" : "larger") + ", write " +
           decimal_text(written * factor, 6);
  }
  return "";
}

/// The same for all numbers of a scene: "membrane[0].stiffness = 0.57 N/m is unusual. If you meant 0.57 N/mm, ...".
inline std::vector<std::string> unusual(const Scene& scene) {
  std::vector<std::string> all;
  for_each_value(scene, [&](const std::string& path, const Field& field, const double& number) {
    const std::string advice = unusual(path, number);
    if (advice.empty()) return;
    all.push_back(path + " = " + decimal_text(number, 6) + " " + std::string(field.unit) + " is unusual. " + advice);
  });
  return all;
}

}  // namespace punctura
