// Everything that can be wrong with a scene, found at once.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "punctura/device/placement.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"
#include "punctura/scene/scene.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

inline constexpr Field coupling_fields[] = {
    {"stiffness",
     "K",
     "N/m",
     {0, no_bound, true, true, "must be greater than 0: the proxy hangs on this spring, K06 (21)"}},
    {"damping", "B", "N s/m", {0, no_bound, false, true, "must be 0 or more, K06 (21)"}},
};

inline constexpr Field servo_fields[] = {
    {"rate",
     "1/T",
     "Hz",
     {100, 1e5, false, false, "must be from 100 to 100000 Hz: below, forces step; above, no device follows"}},
    {"low_pass", "-", "Hz", {0, no_bound, false, true, "must be 0 (off) or more"}},
    {"encoder_step",
     "-",
     "m",
     {0, 1e-3, false, false, "must be from 0 (an ideal sensor) to 0.001 m: no device counts coarser"}},
};

inline constexpr Field gate_fields[] = {
    {"max_speed", "-", "m/s", {0, no_bound, true, true, "must be greater than 0"}},
    {"stale", "-", "s", {0, no_bound, true, true, "must be greater than 0"}},
    {"deadline", "-", "s", {0, no_bound, true, true, "must be greater than 0"}},
    {"axis_tolerance", "-", "-", {0, 0.1, true, false, "must be greater than 0 and at most 0.1"}},
};

inline constexpr Field limit_fields[] = {
    {"max_force", "-", "N", {0, no_bound, true, true, "must be greater than 0: to give no force, do not arm"}},
    {"continuous_force", "-", "N", {0, no_bound, true, true, "must be greater than 0: to give no force, do not arm"}},
    {"continuous_time", "-", "s", {0, no_bound, true, true, "must be greater than 0"}},
    {"ramp_time", "-", "s", {0, no_bound, true, true, "must be greater than 0: force must not come at once"}},
    {"warm_motor", "-", "-", {0, 1, false, true, "must be from 0 to below 1"}},
};

namespace detail {
inline bool finite(const std::array<double, 3>& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
/// The first entry that is not finite, or else the first of all: what to show of a vector that is wrong.
inline double offender(const std::array<double, 3>& v) noexcept {
  for (double x : v)
    if (!std::isfinite(x)) return x;
  return v[0];
}
}  // namespace detail

inline bool check(const Coupling& coupling, std::vector<Problem>& problems) {
  const bool stiffness = check_field(coupling_fields[0], coupling.stiffness, "coupling", problems);
  const bool damping = check_field(coupling_fields[1], coupling.damping, "coupling", problems);
  return stiffness && damping;
}

/// All problems of a scene, each with its path (`membrane[1].friction`), SI value and reason. Empty: it may be built.
inline std::vector<Problem> check(const Scene& scene) {
  std::vector<Problem> problems;
  check(scene.needle, "needle", problems);
  check(scene.coupling, problems);
  check_field(servo_fields[0], scene.servo.rate, "servo", problems);
  check_field(servo_fields[1], scene.servo.low_pass, "servo", problems);
  check_field(servo_fields[2], scene.servo.encoder_step, "servo", problems);
  if (scene.membranes.empty()) problems.push_back({"membrane", 0, "there must be at least one membrane to go through"});
  if (scene.membranes.size() > max_membranes)
    problems.push_back({"membrane", static_cast<double>(scene.membranes.size()), "there may be 64 membranes at most"});

  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const PlacedMembrane& placed = scene.membranes[i];
    const std::string path = "membrane[" + std::to_string(i) + "]";
    check(placed.membrane, path, problems);
    if (needle_fields[1].range.holds(scene.needle.tip_angle) &&
        membrane_fields[2].range.holds(placed.membrane.friction))
      check_insertion(scene.needle, placed.membrane, path, problems);
    if (!detail::finite(placed.point))
      problems.push_back({path + ".point", detail::offender(placed.point), "must be three finite numbers"});
    const auto& n = placed.inward_normal;
    if (!detail::finite(n))
      problems.push_back({path + ".inward_normal", detail::offender(n), "must be three finite numbers"});
    else if (!(std::hypot(n[0], n[1], n[2]) > 0))
      problems.push_back({path + ".inward_normal", 0, "must be a direction: at least one of the three not 0"});
  }
  return problems;
}

/// All problems of a placement.
inline std::vector<Problem> check(const Placement& placement) {
  std::vector<Problem> problems;
  const auto& r = placement.rotation;
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  if (!(length > 0 && std::isfinite(length)))
    problems.push_back({"placement.rotation", r[0], "must be a quaternion w, x, y, z: four finite numbers, not all 0"});
  if (!detail::finite(placement.offset))
    problems.push_back({"placement.offset", detail::offender(placement.offset), "must be three finite numbers"});
  check_field({"scale", "-", "-", {0, no_bound, true, true, "must be greater than 0"}}, placement.scale, "placement",
              problems);
  check_field({"tip_offset", "-", "m", {}}, placement.tip_offset, "placement", problems);
  return problems;
}

/// All problems of the safety limits.
inline std::vector<Problem> check(const GateLimits& gate, const ForceLimits& limits) {
  std::vector<Problem> problems;
  const double gate_values[] = {gate.max_speed, gate.stale, gate.deadline, gate.axis_tolerance};
  const double limit_values[] = {limits.max_force, limits.continuous_force, limits.continuous_time, limits.ramp_time,
                                 limits.warm_motor};
  for (std::size_t i = 0; i < 4; ++i) check_field(gate_fields[i], gate_values[i], "gate", problems);
  for (std::size_t i = 0; i < 5; ++i) check_field(limit_fields[i], limit_values[i], "limits", problems);
  return problems;
}

}  // namespace punctura
