// The fields of a scene by their path, for example "membrane[0].friction". Problems use the same paths.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "punctura/scene/check.hpp"

namespace punctura {

namespace detail {
template <typename Value>
inline constexpr bool is_list = false;
template <typename Row>
inline constexpr bool is_list<std::vector<Row>> = true;

/// Calls visit(path, row, value) for each row of a table. at: what stands before the name, as "membrane[0].".
template <typename Rows, typename Owner, typename Visit>
void visit_table(const std::string& at, const Rows& rows, Owner& owner, Visit& visit) {
  for_each_row(rows, [&](const auto& row) { visit(at + std::string(row.name), row, owner.*row.member); });
}

template <typename PlacedT, typename Visit>
void visit_membrane(const std::string& at, PlacedT& placed, Visit& visit) {
  for_each_row(placed_rows, [&](const auto& row) {
    auto& value = placed.*row.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, Membrane>)
      visit_table(at, membrane_fields, value, visit);
    else if constexpr (std::is_same_v<Value, Tissue>)
      visit_table(at, tissue_rows, value, visit);
    else if constexpr (std::is_same_v<Value, Outlet>)
      visit_table(at, &value == &placed.outflow ? outflow_fields : outflow_behind_fields, value, visit);
    else
      visit(at + std::string(row.name), row, value);
  });
}
}  // namespace detail

/// Calls visit(path, row, value) for each field of a scene, in the order of the file: numbers, words, texts, vectors
/// and lists of rows (columns_of). row: its FieldOf.
///
/// SceneT: Scene or const Scene. value is a reference into the scene.
template <typename SceneT, typename Visit>
void visit_scene(SceneT& scene, Visit&& visit) {
  visit("name", scene_name_field, scene.name);
  detail::visit_table("needle.", needle_fields, scene.needle, visit);
  visit("needle.direction", direction_field, scene.direction);
  detail::visit_table("coupling.", coupling_fields, scene.coupling, visit);
  visit("coupling.relaxation", relaxation_field, scene.relaxation);
  detail::visit_table("servo.", servo_rows, scene.servo, visit);
  detail::visit_table("display.", display_fields, scene.display, visit);
  if (scene.syringe) {
    detail::visit_table("syringe.", syringe_fields, scene.syringe->syringe, visit);
    detail::visit_table("syringe.", thumb_fields, scene.syringe->thumb, visit);
  }
  for (std::size_t i = 0; i < scene.membranes.size(); ++i)
    detail::visit_membrane("membrane[" + std::to_string(i) + "].", scene.membranes[i], visit);
}

/// Calls visit(path, field, number) for each number of a scene that has a meaning in it, in the order of the file.
///
/// SceneT: Scene or const Scene. number is a reference into the scene.
template <typename SceneT, typename Visit>
void for_each_value(SceneT& scene, Visit&& visit) {
  visit_scene(scene, [&](const std::string& path, const auto& row, auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<decltype(row), const FieldOf<DisplaySettings>&>) {
      if (scene.display.automatic) return;
    } else if constexpr (std::is_same_v<decltype(row), const FieldOf<Outlet>&>) {
      if (!scene.syringe) return;  // nothing else reads the outlets
    }
    const Field& field = row;
    if constexpr (std::is_same_v<Value, double>)
      visit(path, field, value);
    else if constexpr (std::is_same_v<Value, std::array<double, 3>>)
      for (std::size_t k = 0; k < 3; ++k) visit(path + "[" + std::to_string(k) + "]", field, value[k]);
    else if constexpr (detail::is_list<Value>)
      for (std::size_t i = 0; i < value.size(); ++i)
        detail::visit_table(path + "[" + std::to_string(i) + "].", columns_of<typename Value::value_type>, value[i],
                            visit);
  });
}

}  // namespace punctura
