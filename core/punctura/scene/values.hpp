// The numbers of a scene by their path, for example "membrane[0].friction". Problems use the same paths.
#pragma once

#include <string>

#include "punctura/scene/check.hpp"

namespace punctura {

inline constexpr Field point_fields[] = {
    {"point[0]", "a", "m", {}}, {"point[1]", "a", "m", {}}, {"point[2]", "a", "m", {}}};
inline constexpr Field normal_fields[] = {
    {"inward_normal[0]", "n", "-", {}}, {"inward_normal[1]", "n", "-", {}}, {"inward_normal[2]", "n", "-", {}}};

inline constexpr Field grip_point_fields[] = {{"opening", "y", "m", {0, 1}}, {"grip", "G", "N", {0, 1e6}}};
inline constexpr Field knot_fields[] = {
    {"depth", "q", "m", {0, 1e6}}, {"lower", "phi_I", "N", {-1e6, 0}}, {"upper", "phi_O", "N", {-1e6, 1e6}}};

/// Calls visit(path, field, number) for each number of the tissue of the membrane at `path`.
template <typename TissueT, typename Visit>
void visit_tissue(const std::string& path, TissueT& tissue, Visit& visit) {
  for (const auto& field : tissue_fields) visit(path + "." + std::string(field.name), field, tissue.*field.member);
  const auto list = [&](const char* name, auto& rows, const auto& fields, const auto&... members) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::size_t k = 0;
      const std::string row = path + "." + name + "[" + std::to_string(i) + "].";
      ((visit(row + std::string(fields[k].name), fields[k], rows[i].*members), ++k), ...);
    }
  };
  list("grip_table", tissue.grip_table, grip_point_fields, &GripPoint::opening, &GripPoint::grip);
  list("profile", tissue.profile, knot_fields, &Knot::depth, &Knot::lower, &Knot::upper);
}

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
  for (std::size_t i = 0; i < scene.relaxation.size(); ++i)
    all("coupling.relaxation[" + std::to_string(i) + "]", branch_fields, scene.relaxation[i]);
  all("servo", servo_fields, scene.servo);
  if (!scene.display.automatic) all("display", display_fields, scene.display);
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const std::string path = "membrane[" + std::to_string(i) + "]";
    auto& placed = scene.membranes[i];
    all(path, membrane_fields, placed.membrane);
    visit_tissue(path, placed.tissue, visit);
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
