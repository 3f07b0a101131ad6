// The lumen of a vessel: the space between the membrane with `behind = blood` and the next membrane.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "punctura/model/validity.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/scene/scene.hpp"

namespace punctura {

/// The next membrane behind membrane i, along the inward normal of membrane i. Empty if there is none.
inline std::optional<std::size_t> next_behind(const Scene& scene, std::size_t i) noexcept {
  const Vector3d here = to_vector(scene.membranes[i].point), inward = to_vector(scene.membranes[i].inward_normal);
  std::optional<std::size_t> next;
  double nearest = no_bound;
  for (std::size_t j = 0; j < scene.membranes.size(); ++j) {
    const double distance = (to_vector(scene.membranes[j].point) - here).dot(inward);
    if (j == i || !(distance > 0 && distance < nearest)) continue;
    nearest = distance;
    next = j;
  }
  return next;
}

/// The two membranes that bound the lumen: the one in front and the one behind. Empty if the scene has no blood.
inline std::optional<std::pair<std::size_t, std::size_t>> lumen(const Scene& scene) noexcept {
  for (std::size_t i = 0; i < scene.membranes.size(); ++i)
    if (scene.membranes[i].behind == Behind::blood)
      if (const auto j = next_behind(scene, i)) return std::pair(i, *j);
  return std::nullopt;
}

/// Adds a problem if more than one membrane has blood behind it, or if no other membrane bounds the blood. What bounds
/// it is not known before each membrane has a place.
inline void check_lumen(const Scene& scene, std::vector<Problem>& problems) {
  const auto blood = static_cast<double>(Behind::blood);
  const bool placed = std::all_of(scene.membranes.begin(), scene.membranes.end(), [](const PlacedMembrane& m) {
    return is_place(to_vector(m.point)) && is_place(to_vector(m.inward_normal));
  });
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    if (scene.membranes[i].behind != Behind::blood) continue;
    const std::string path = "membrane[" + std::to_string(i) + "].behind";
    if (first)
      problems.push_back(
          {path, blood,
           "only one membrane may have blood behind it; membrane[" + std::to_string(*first) + "] has it already"});
    else if (first = i; placed && !next_behind(scene, i))
      problems.push_back({path, blood, "no other membrane bounds the blood behind this one"});
  }
}

}  // namespace punctura
