// The checks of a scene. They find all problems at once.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "punctura/device/placement.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"
#include "punctura/scene/check_law.hpp"
#include "punctura/scene/fields.hpp"
#include "punctura/scene/lumen.hpp"
#include "punctura/scene/name.hpp"
#include "punctura/scene/scene.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

// clang-format off
inline constexpr std::tuple gate_rows{
    FieldOf<GateLimits>{{"max_speed", "", "m/s", greater_than_0, "Between two readings."}, &GateLimits::max_speed},
    FieldOf<GateLimits>{{"stale", "", "s", greater_than_0, "Longest time without a new reading."}, &GateLimits::stale},
    FieldOf<GateLimits>{{"deadline", "", "s", greater_than_0, "Longest time between ticks."}, &GateLimits::deadline},
    FieldOf<GateLimits>{{"axis_tolerance", "", "-", {0, 0.1, true},
      "Deviation of the axis' length from 1."}, &GateLimits::axis_tolerance},
    FieldOf<GateLimits, std::uint32_t>{{"dead_man", "", "", {},
      "Buttons (bits), one of which must be held; 0 for none."}, &GateLimits::dead_man},
};
inline constexpr auto gate_fields = numbers_of(gate_rows);

inline constexpr Range a_force = {0, no_bound, true, true, ": to give no force, do not arm"};
inline constexpr FieldOf<ForceLimits> limit_fields[] = {
    {{"max_force", "", "N", a_force, "Norm."}, &ForceLimits::max_force},
    {{"continuous_force", "", "N", a_force, "Rms, over any continuous_time."}, &ForceLimits::continuous_force},
    {{"continuous_time", "", "s",
      {0, 60, true, false, ": over a longer time motors would overheat"},
      "Of the rms."}, &ForceLimits::continuous_time},
    {{"ramp_time", "", "s", {0, no_bound, true, true, ": force must not come at once"},
      "From zero to full force after arming."}, &ForceLimits::ramp_time},
    {{"warm_motor", "", "-", {0, 1, false, true},
      "Motor temperature (0 to 1) above which the force decreases, to zero at 1."}, &ForceLimits::warm_motor},
};

inline constexpr std::tuple placement_rows{
    FieldOf<Placement, std::array<double, 4>>{{"rotation", "", "", {},
      "Quaternion w, x, y, z, of any length but 0."}, &Placement::rotation},
    FieldOf<Placement, std::array<double, 3>>{{"offset", "", "m", {}, "In the scene."}, &Placement::offset},
    FieldOf<Placement>{{"scale", "", "-", greater_than_0, "Scene metres per device metre."}, &Placement::scale},
    FieldOf<Placement>{{"tip_offset", "", "m", {},
      "From the device's point to the tip along the stylus."}, &Placement::tip_offset},
};
// clang-format on
inline constexpr auto placement_fields = numbers_of(placement_rows);

namespace detail {
inline bool finite(const std::array<double, 3>& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
/// The value to show for a wrong vector: its first entry that is not a place, otherwise its first entry.
inline double value_to_show(const std::array<double, 3>& v) noexcept {
  for (double x : v)
    if (!is_place(x)) return x;
  return v[0];
}
}  // namespace detail

inline bool check(const Coupling& coupling, std::vector<Problem>& problems) {
  return check_fields(coupling_fields, coupling, "coupling", problems);
}

inline void check_relaxation(const Scene& scene, std::vector<Problem>& problems) {
  static_assert(max_branches == 2);
  const auto& branches = scene.relaxation;
  if (branches.size() > max_branches)
    problems.push_back(
        {"coupling.relaxation", static_cast<double>(branches.size()), "there may be at most two branches"});
  for (std::size_t i = 0; i < branches.size(); ++i)
    check_fields(branch_fields, branches[i], "coupling.relaxation[" + std::to_string(i) + "]", problems);
}

inline void check(const SyringeSettings& settings, std::vector<Problem>& problems) {
  check(settings.syringe, "syringe", problems);
  check_fields(thumb_fields, settings.thumb, "syringe", problems);
}

inline void check(const ServoSettings& servo, std::vector<Problem>& problems) {
  if (check_fields(servo_fields, servo, "servo", problems) && std::trunc(servo.sub_steps) != servo.sub_steps)
    problems.push_back(
        {"servo.sub_steps", servo.sub_steps, bound_text(field_of(servo_fields, &ServoSettings::sub_steps))});
}

/// The problems of a membrane's place: point and inward normal.
inline void check_place(const PlacedMembrane& placed, const std::string& path, std::vector<Problem>& problems) {
  if (!is_place(to_vector(placed.point)))
    problems.push_back(
        {path + ".point", detail::value_to_show(placed.point), "must be three finite numbers, m, within 1000 km"});
  const auto& n = placed.inward_normal;
  if (!detail::finite(n))
    problems.push_back({path + ".inward_normal", detail::value_to_show(n), "must be three finite numbers"});
  else if (!(std::hypot(n[0], n[1], n[2]) > 0))
    problems.push_back({path + ".inward_normal", 0, "must be a direction: at least one of the three not 0"});
}

static_assert(max_membranes == 64);
inline constexpr const char* too_many_membranes = "there may be at most 64 membranes";

/// All problems of a scene, each with its path (`membrane[1].friction`), its SI value and the reason. If there are
/// none, the scene can be built.
inline std::vector<Problem> check(const Scene& scene) {
  std::vector<Problem> problems;
  check_name(scene.name, "name", problems);
  const bool needle = check(scene.needle, "needle", problems);
  check(scene.coupling, problems);
  check_relaxation(scene, problems);
  check(scene.servo, problems);
  check_fields(display_fields, scene.display, "display", problems);
  if (scene.membranes.empty()) problems.push_back({"membrane", 0, "there must be at least one membrane to go through"});
  if (scene.membranes.size() > max_membranes)
    problems.push_back({"membrane", static_cast<double>(scene.membranes.size()), too_many_membranes});

  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const PlacedMembrane& placed = scene.membranes[i];
    const std::string path = "membrane[" + std::to_string(i) + "]";
    check_name(placed.name, path + ".name", problems);
    const bool membrane = check(placed.membrane, path, problems), tissue = check(placed.tissue, path, problems);
    const bool enters = field_of(needle_fields, &Needle::tip_angle).range.holds(scene.needle.tip_angle) &&
                        field_of(membrane_fields, &Membrane::friction).range.holds(placed.membrane.friction) &&
                        check_insertion(scene.needle, placed.membrane, path, problems);
    if (needle && membrane && tissue && enters &&
        check_curve(scene.needle, placed.membrane, placed.tissue, path, problems)) {
      constexpr auto widest = grazing_cosine<double>;  // at this angle a band is the largest
      if (is_k06(placed.tissue))
        check_law(ThickLaw(scene.needle, placed.membrane).pieces(widest), path, problems, true);
      else
        check_law(TissueLaw(scene.needle, placed.membrane, placed.tissue).pieces(widest), path, problems, true);
    }
    check_fields(outflow_fields, placed.outflow, path, problems);
    check_fields(outflow_behind_fields, placed.outflow_behind, path, problems);
    check_place(placed, path, problems);
  }
  check_lumen(scene, problems);
  if (scene.syringe) check(*scene.syringe, problems);
  return problems;
}

inline std::vector<Problem> check(const Placement& placement) {
  std::vector<Problem> problems;
  const auto& r = placement.rotation;
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  if (!(length > 0 && std::isfinite(length)))
    problems.push_back({"placement.rotation", r[0], "must be a quaternion w, x, y, z: four finite numbers, not all 0"});
  if (!detail::finite(placement.offset))
    problems.push_back({"placement.offset", detail::value_to_show(placement.offset), "must be three finite numbers"});
  check_fields(placement_fields, placement, "placement", problems);
  return problems;
}

inline std::vector<Problem> check(const GateLimits& gate, const ForceLimits& limits) {
  std::vector<Problem> problems;
  check_fields(gate_fields, gate, "gate", problems);
  check_fields(limit_fields, limits, "limits", problems);
  return problems;
}

}  // namespace punctura
