// core/punctura/model: the law of measured tissue.
#include "punctura/model/tissue_law.hpp"

#include <cmath>

#include "arguments.hpp"
#include "bindings.hpp"
#include "law_bounds.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

GivenTissueLaw make_tissue_law(Needle needle, Membrane membrane, Tissue tissue, double obliquity) {
  auto problems = problems_of(needle, membrane);
  check_field(obliquity_field, obliquity, "", problems);
  if (check(tissue, "tissue", problems) && problems.empty()) check_curve(needle, membrane, tissue, "tissue", problems);
  raise_if(problems);
  return {TissueLaw(needle, membrane, tissue, std::cos(obliquity)), needle, membrane, tissue, obliquity};
}

}  // namespace

void bind_tissue_law(nb::module_& m) {
  auto law = nb::class_<GivenTissueLaw>(
      m, "TissueLaw",
      "Law of a membrane of measured tissue. A proxy remembers its hole until it is reset.\n\n"
      "With Tissue() it is ThickLaw, bit for bit. docs/measured-tissue.md derives it.");
  law.def_ro("needle", &GivenTissueLaw::needle)
      .def_ro("membrane", &GivenTissueLaw::membrane)
      .def_ro("tissue", &GivenTissueLaw::tissue)
      .def_ro("obliquity", &GivenTissueLaw::obliquity, "beta, rad")
      .def_prop_ro("X", &GivenTissueLaw::tip_length, "Length of the tip, m. K06 (15), or Tissue.tip_length");
  def_bounds(law);
  def_init(
      law, &make_tissue_law, nb::arg("needle"), nb::arg("membrane"), nb::arg("tissue"), nb::arg("obliquity") = 0.0,
      "bounds() are those of an untouched wall. obliquity: beta, rad. Raises ConfigurationError with all problems.");
  def_value(law, {"needle", "membrane", "tissue", "obliquity"});
}

}  // namespace punctura::bindings
