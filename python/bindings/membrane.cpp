// core/punctura/scene: a membrane with its place and its tissue, and the branches of a coupling that relaxes.
#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "struct.hpp"

template <>
struct nb::detail::type_caster<punctura::GripPoint> : row_caster<punctura::GripPoint> {};
template <>
struct nb::detail::type_caster<punctura::Knot> : row_caster<punctura::Knot> {};

namespace punctura::bindings {

void bind_membrane(nb::module_& m) {
  def_struct<tissue_rows>(
      m,
      {"Tissue", "What a membrane of measured tissue has beside the four numbers of K06.", "tissue",
       "Tissue() is K06's membrane. A profile replaces grip and tail. docs/measured-tissue.md. Raises\n"
       "ConfigurationError."},
      [](const Tissue& made, std::vector<Problem>& problems) { check(made, "tissue", problems); });
  def_struct<branch_fields>(m, {"MaxwellBranch",
                                "A spring in series with a damper, beside the coupling: it relaxes while the needle "
                                "rests.",
                                "coupling.relaxation"});
  def_struct<placed_rows>(
      m, {.name = "PlacedMembrane", .doc = "A membrane and its place in the scene.", .path = "membrane", .needed = 4},
      [](const PlacedMembrane& made, std::vector<Problem>& problems) { check_place(made, "membrane", problems); });
}

}  // namespace punctura::bindings
