// The model of a scene: the law of each membrane and the coupling.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "punctura/insertion/scene_insertion.hpp"
#include "punctura/scene/scene.hpp"

namespace punctura {

/// Whether a scene has no law and no coupling beyond K06. Such a scene runs the smaller model (K06Insertion).
inline bool is_k06(const Scene& scene) noexcept {
  for (const MaxwellBranch& branch : scene.relaxation)
    if (branch.stiffness != 0) return false;
  for (const PlacedMembrane& placed : scene.membranes)
    if (!is_k06(placed.tissue)) return false;
  return true;
}

namespace detail {
/// The insertion of a scene that has passed check(). coupling: of a sub-step. law_of: see GivesLaws.
template <typename Scalar, typename C, typename LawOf>
auto insertion_of(const Scene& scene, const C& coupling, LawOf&& law_of) {
  using L = std::remove_cvref_t<decltype(law_of(BasicNeedle<Scalar>{}, BasicMembrane<Scalar>{}, std::size_t{}))>;
  static_assert(check_is_law<L>());
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const BasicNeedle<Scalar> needle{to(scene.needle.diameter), to(scene.needle.tip_angle)};
  std::vector<SiteOf<L>> sites;
  for (const PlacedMembrane& placed : scene.membranes) {
    const Membrane& m = placed.membrane;
    const BasicMembrane<Scalar> membrane{to(m.stiffness), to(m.precompression), to(m.friction), to(m.thickness)};
    const Vector3d normal = to_vector(placed.inward_normal).stableNormalized();
    sites.push_back({law_of(needle, membrane, sites.size()), to_vector(placed.point).template cast<Scalar>(),
                     normal.template cast<Scalar>()});
  }
  return InsertionOf<L, C>(sites, coupling, to(1 / scene.servo.rate), scene.servo.solver, to(scene.servo.low_pass),
                           scene.direction, scene.servo.conditioning, to(scene.servo.encoder_step),
                           static_cast<std::uint32_t>(scene.servo.sub_steps));
}

/// The coupling of a scene that has passed check(), sampled with the period of a sub-step.
template <typename Scalar>
SampledCoupling<Scalar> coupling_of(const Scene& scene) {
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  return {{to(scene.coupling.stiffness), to(scene.coupling.damping)},
          to(1 / scene.servo.rate) / to(scene.servo.sub_steps)};
}
template <typename Scalar>
RelaxingCoupling<Scalar> relaxing_coupling_of(const Scene& scene) {
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const SampledCoupling<Scalar> c = coupling_of<Scalar>(scene);
  std::vector<BasicMaxwellBranch<Scalar>> branches;
  for (const MaxwellBranch& b : scene.relaxation) branches.push_back({to(b.stiffness), to(b.time_constant)});
  return {{c.K, c.B}, branches, c.T};
}

template <typename Scalar>
BasicTissue<Scalar> tissue_as(const Tissue& tissue) {
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  BasicTissue<Scalar> made;
  made.grip = tissue.grip;
  constexpr auto numbers = numbers_of<Scalar>(tissue_rows_of<Scalar>);
  for (std::size_t i = 0; i < numbers.size(); ++i) made.*numbers[i].member = to(tissue.*tissue_fields[i].member);
  for (const GripPoint& p : tissue.grip_table) made.grip_table.push_back({to(p.opening), to(p.grip)});
  for (const Knot& k : tissue.profile) made.profile.push_back({to(k.depth), to(k.lower), to(k.upper)});
  return made;
}
}  // namespace detail

/// The law of each membrane as the scene describes it: law_of(needle, membrane, i) for membrane i.
/// The scene must outlive the result.
template <typename Scalar>
auto scene_law_of(const Scene& scene) {
  return [&scene](const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane, std::size_t i) {
    return SceneLaw<Scalar>(needle, membrane, detail::tissue_as<Scalar>(scene.membranes[i].tissue));
  };
}

namespace detail {
/// The model of a scene that has passed check(), also of one of K06, with the laws that hold everything.
template <typename Scalar>
WideInsertion<Scalar> wide_model_of(const Scene& scene) {
  return insertion_of<Scalar>(scene, relaxing_coupling_of<Scalar>(scene), scene_law_of<Scalar>(scene));
}
/// The model of a scene that has passed check().
template <typename Scalar>
BasicInsertion<Scalar> model_of(const Scene& scene) {
  if (!is_k06(scene)) return wide_model_of<Scalar>(scene);
  return insertion_of<Scalar>(
      scene, coupling_of<Scalar>(scene),
      [](const auto& needle, const auto& membrane, std::size_t) { return BasicThickLaw<Scalar>(needle, membrane); });
}
}  // namespace detail

}  // namespace punctura
