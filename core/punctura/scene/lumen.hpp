// Where blood is: behind the one membrane that says so, up to the next one in the way.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "punctura/model/validity.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/scene/scene.hpp"

namespace punctura {

/// The membrane that a needle meets next after membrane i, going straight in. Empty if there is no other.
inline std::optional<std::size_t> next_behind(const Scene& scene, std::size_t i) noexcept {
  const Vector3d here = to_vector(scene.membranes[i].point), inward = to_vector(scene.membranes[i].inward_normal);
  std::optional<std::size_t> next;
  double nearest = no_bound;
  for (std::size_t j = 0; j < scene.membranes.size(); ++j) {
    const double way = (to_vector(scene.membranes[j].point) - here).dot(inward);
    if (j == i || !(way > 0 && way < nearest)) continue;
    nearest = way;
    next = j;
  }
  return next;
}

/// The two membranes between which blood is, if any.
inline std::optional<std::pair<std::size_t, std::size_t>> lumen(const Scene& scene) noexcept {
  for (std::size_t i = 0; i < scene.membranes.size(); ++i)
    if (scene.membranes[i].behind == Behind::blood)
      if (const auto j = next_behind(scene, i)) return std::pair(i, *j);
  return std::nullopt;
}

/// At most one membrane may have blood behind it, and another membrane must bound it.
inline void check_lumen(const Scene& scene, std::vector<Problem>& problems) {
  const auto blood = static_cast<double>(Behind::blood);
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    if (scene.membranes[i].behind != Behind::blood) continue;
    const std::string path = "membrane[" + std::to_string(i) + "].behind";
    if (first)
      problems.push_back(
          {path, blood,
           "only one membrane may have blood behind it; membrane[" + std::to_string(*first) + "] has it already"});
    else if (first = i; !next_behind(scene, i))
      problems.push_back({path, blood, "no other membrane bounds the blood behind this one"});
  }
}

}  // namespace punctura
