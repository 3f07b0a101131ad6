// The usual sizes of a scene's numbers. A number that is off by a factor of 1,000 is possible, but hardly meant.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/scene/keys.hpp"

namespace punctura {

/// A unit of a field; its size in SI.
struct UsualUnit {
  std::string_view name;
  double size;
};

/// The units in which a number is often given, by its SI unit, which is the first.
inline constexpr UsualUnit usual_units[][3] = {
    {{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}},
    {{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}},
    {{"N/m", 1}, {"N/mm", 1e3}, {"N/um", 1e6}},
    {{"m^3", 1}, {"mL", 1e-6}, {"L", 1e-3}},
    {{"m^3/Pa", 1}, {"mL/kPa", 1e-9}, {"mL/Pa", 1e-6}},
    {{"Pa s/m^3", 1}, {"kPa s/mL", 1e9}, {"Pa s/mL", 1e6}},
};

/// The field of a path such as "membrane[0].stiffness"; null if it is no number of a scene.
inline const Field* scene_field(std::string path) {
  static const auto fields = [] {
    std::map<std::string, Field> all;
    for (const SceneKey& key : scene_keys()) all.try_emplace(std::string(key.table) + "." + key.name, key.field);
    return all;
  }();
  const std::size_t from = path.find('['), to = path.find(']');
  if (from != std::string::npos && to != std::string::npos && from < to) path.erase(from, to - from + 1);
  const auto found = fields.find(path);
  return found == fields.end() ? nullptr : &found->second;
}

/// What to write instead of a number that is off by a factor of 1,000 or 1,000,000; "" if it is not.
///
/// written: the number in a unit of `size` in SI. The answer is in the same unit: "If you meant 570 N/m, write 0.57".
inline std::string unusual(const std::string& path, double written, double size = 1) {
  const Field* field = scene_field(path);
  const auto found = [&](double v) { return std::abs(v) >= field->usual.low && std::abs(v) <= field->usual.high; };
  if (!field || written == 0 || found(written * size)) return "";
  const std::string number = decimal_text(written, 6);
  for (const auto& units : usual_units)
    for (const UsualUnit& unit : units) {
      if (units[0].name != field->unit || !found(written * unit.size)) continue;
      // The first unit that fits. Rounded: the product of doubles has digits that nobody wrote.
      return "If you meant " + number + " " + std::string(unit.name) + ", write " +
             decimal_text(written * unit.size / size, 6);
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
