// The numbers of a scene by their path, for example "membrane[0].friction". Problems use the same paths.
#pragma once

#include <string>

#include "punctura/scene/check.hpp"

namespace punctura {

inline constexpr Field point_fields[] = {
    {"point[0]", "a", "m", {}}, {"point[1]", "a", "m", {}}, {"point[2]", "a", "m", {}}};
inline constexpr Field normal_fields[] = {
    {"inward_normal[0]", "n", "-", {}}, {"inward_normal[1]", "n", "-", {}}, {"inward_normal[2]", "n", "-", {}}};

/// Calls visit(path, field, number) for each number of a scene, in the order of the file.
///
/// SceneT: Scene or const Scene. number is a reference into the scene.
template <typename SceneT, typename Visit>
void for_each_value(SceneT& scene, Visit&& visit) {
  const auto all = [&](const std::string& path, const auto& fields, auto& owner) {
    for (const auto& field : fields) visit(path + "." + std::string(field.name), field, owner.*field.member);
  };
  all("needle", needle_fields, scene.needle);
  all("coupling", coupling_fields, scene.coupling);
  all("servo", servo_fields, scene.servo);
  if (!scene.display.automatic) all("display", display_fields, scene.display);
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const std::string path = "membrane[" + std::to_string(i) + "]";
    auto& placed = scene.membranes[i];
    all(path, membrane_fields, placed.membrane);
    for (std::size_t k = 0; k < 3; ++k)
      visit(path + "." + std::string(point_fields[k].name), point_fields[k], placed.point[k]);
    for (std::size_t k = 0; k < 3; ++k)
      visit(path + "." + std::string(normal_fields[k].name), normal_fields[k], placed.inward_normal[k]);
    if (!scene.syringe) continue;  // nothing else reads the outlets
    all(path, outflow_fields, placed.outflow);
    all(path, outflow_behind_fields, placed.outflow_behind);
  }
  if (!scene.syringe) return;
  all("syringe", syringe_fields, scene.syringe->syringe);
  all("syringe", thumb_fields, scene.syringe->thumb);
}

}  // namespace punctura
