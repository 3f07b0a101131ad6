// core/punctura/model: the law of measured tissue.
#include "punctura/model/tissue_law.hpp"

#include "arguments.hpp"
#include "bindings.hpp"
#include "law_bounds.hpp"
#include "struct.hpp"

namespace punctura::bindings {
namespace {

constexpr std::tuple law_rows{
    row("needle", &TissueArguments::needle),
    row("membrane", &TissueArguments::membrane),
    row("tissue", &TissueArguments::tissue),
    row("obliquity", &TissueArguments::obliquity, "beta, rad."),
};

}  // namespace

void bind_tissue_law(nb::module_& m) {
  auto law = def_struct<law_rows, GivenTissueLaw>(
      m,
      {.name = "TissueLaw",
       .doc = "Law of a membrane of measured tissue. A proxy remembers its hole until it is reset.\n\n"
              "With Tissue() it is ThickLaw, bit for bit. docs/measured-tissue.md derives it.",
       .raises = "bounds() are those of an untouched wall. Raises ConfigurationError with all problems.",
       .needed = 3},
      [](const TissueArguments& made, std::vector<Problem>& problems) {
        problems = problems_of(made.needle, made.membrane);
        check_field(obliquity_field, made.obliquity, "", problems);
        if (check(made.tissue, "tissue", problems) && problems.empty())
          check_curve(made.needle, made.membrane, made.tissue, "tissue", problems);
      });
  law.def_prop_ro("X", &GivenTissueLaw::tip_length, "Length of the tip, m. K06 (15), or Tissue.tip_length");
  def_bounds(law);
}

}  // namespace punctura::bindings
