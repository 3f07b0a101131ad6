// Where a simulated hand begins, and between which ends it strokes through a scene.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "punctura/lab/events/law_curve.hpp"
#include "punctura/lab/plant/hand.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/proxy/in_space.hpp"
#include "punctura/scene/lumen.hpp"

namespace punctura {

/// The two ends of a hand's strokes, m: in front of all membranes, and behind the last.
struct StrokeEnds {
  Vector3d start, end;
};

/// The strokes go along the first membrane's inward normal. scene must have passed check().
///
/// The far end adds the lag of the tip under the membranes' largest forces F: F / K of each in the coupling, and
/// sum(F) / k in the hand's spring k. So the tip itself comes out behind.
inline StrokeEnds stroke_ends(const Scene& scene) {
  constexpr double clearance = 5e-3;  // m in front of the first surface, where the force may begin
  constexpr double beyond = 3e-3;     // m of shaft behind the last membrane, a margin for the device's own friction
  const Vector3d first = to_vector(scene.membranes[0].point);
  const Vector3d inward = to_vector(scene.membranes[0].inward_normal).stableNormalized();
  double start = 0, end = 0, held_back = 0;
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const PlacedMembrane& placed = scene.membranes[i];
    Vector3d normal = to_vector(placed.inward_normal).stableNormalized();
    if (normal.dot(inward) < 0) normal = -1.0 * normal;  // a back wall may have the opposite normal
    // At a flatter angle the proxy refuses the entry.
    const double cosine = std::max(normal.dot(inward), grazing_cosine<double>);
    const MembraneLaw law = membrane_law(scene, i, std::acos(std::min(1.0, cosine)));
    const double largest = std::max(-*std::min_element(law.curve.lower.begin(), law.curve.lower.end()),
                                    *std::max_element(law.curve.upper.begin(), law.curve.upper.end()));
    const double surface = (to_vector(placed.point) - first).dot(normal) / cosine;
    start = i == 0 ? surface : std::min(start, surface);
    const double behind = surface + law.through + largest / scene.coupling.stiffness;
    end = i == 0 ? behind : std::max(end, behind);
    held_back += largest / Hand{}.stiffness;
  }
  return {first + (start - clearance) * inward, first + (end + held_back + beyond) * inward};
}

/// A position, m, and the unit direction of the needle.
struct HandPose {
  Vector3d position, axis;
};

/// The first pose of a hand: in front of all membranes, pointing into the first. scene must have passed check().
///
/// In a scene with blood, the needle is close to the skin, at 30 degrees to it, and points to the middle of the scene:
/// the slanted tip of an upright needle is longer than a vein is wide.
inline HandPose resting_pose(const Scene& scene) {
  constexpr double vessel_angle = std::numbers::pi / 6;  // to the skin; illustrative
  constexpr double vessel_gap = 3e-3;                    // m along the needle to the skin; illustrative
  const Vector3d first = to_vector(scene.membranes[0].point);
  const Vector3d inward = to_vector(scene.membranes[0].inward_normal).stableNormalized();
  if (!lumen(scene)) return {stroke_ends(scene).start, inward};
  const Vector3d right = std::abs(inward[0]) > 0.9 ? Vector3d(0, 0, 1) : Vector3d(1, 0, 0);
  const Vector3d along = (right - right.dot(inward) * inward).stableNormalized();
  const Vector3d axis = std::sin(vessel_angle) * inward + std::cos(vessel_angle) * along;
  double behind = 0;
  for (const PlacedMembrane& placed : scene.membranes)
    behind = std::max(behind, (to_vector(placed.point) - first).dot(inward) + placed.membrane.thickness);
  const double ahead = behind / 2 / std::sin(vessel_angle) + vessel_gap;
  return {first + behind / 2 * inward - ahead * axis, axis};
}

}  // namespace punctura
