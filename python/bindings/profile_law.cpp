// core/punctura/model: the law of a profile.
#include "punctura/model/profile_law.hpp"

#include <cmath>

#include "arguments.hpp"
#include "bindings.hpp"
#include "law_bounds.hpp"
#include "punctura/model/validity.hpp"
#include "state.hpp"
#include "value.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

GivenProfileLaw make_profile_law(std::vector<double> depth, std::vector<double> lower, std::vector<double> upper,
                                 double thickness, double obliquity) {
  std::vector<Problem> problems;
  const std::size_t n = depth.size();
  for (const auto& [name, values] : {std::pair{"lower", &lower}, std::pair{"upper", &upper}})
    if (values->size() != n)
      problems.push_back({std::string("len(") + name + ")", static_cast<double>(values->size()),
                          "must be the number of depths, " + std::to_string(n)});
  if (n == 0 || n > max_knots) problems.push_back({"len(depth)", static_cast<double>(n), "must be 1 to 32 knots"});
  const Field& H = field_of(membrane_fields, &Membrane::thickness);
  check_field(H, thickness, "", problems);
  check_field(obliquity_field, obliquity, "", problems);
  raise_if(problems);
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < n; ++i) knots.push_back({depth[i], lower[i], upper[i]});
  const auto path_of = [](std::size_t i, const char* field) {
    return std::string(field) + "[" + std::to_string(i) + "]";
  };
  check_profile(knots, "depth", path_of, problems);
  raise_if(problems);
  return {ProfileLaw(Profile(knots), thickness, std::cos(obliquity)), depth, lower, upper, obliquity};
}

/// The weights of the knots at all depths, of shape depths.shape + (knots,).
Floats weights(const GivenProfileLaw& law, const ArrayLike& depths) {
  const Input depth = input(depths, "depth");
  const std::size_t n = depth.size(), knots = law.depth.size();
  std::vector<double> all(n * knots);
  {
    const WithoutLock release;
    const double cos_beta = std::cos(law.obliquity);
    for (std::size_t i = 0; i < n; ++i)
      profile_weights<double>(law.depth, law.thickness(), cos_beta, depth.data()[i],
                              std::span(all).subspan(i * knots, knots));
  }
  std::vector<std::size_t> shape;
  if (!is_one_number(depths)) shape.assign(depth.shape_ptr(), depth.shape_ptr() + depth.ndim());
  shape.push_back(knots);
  return to_numpy(std::move(all), shape);
}

}  // namespace

void bind_profile_law(nb::module_& m) {
  auto law = nb::class_<GivenProfileLaw>(
      m, "ProfileLaw",
      "A law from a profile: straight lines between at most 32 knots, averaged over the path through the wall.\n\n"
      "No friction before the first knot; constant edges behind the last one. The edges may jump at the first knot,\n"
      "and at two knots of one depth. K06 (16)");
  def_bounds(law);
  def_init(law, &make_profile_law, nb::arg("depth"), nb::arg("lower"), nb::arg("upper"), nb::arg("thickness") = 0.0,
           nb::arg("obliquity") = 0.0,
           nb::sig("def __init__(self, depth: _Numbers, lower: _Numbers, upper: _Numbers, thickness: float = ..., "
                   "obliquity: float = ...) -> None"),
           "depth: of the knots, m, ascending. lower: phi_I there, N, 0 or less. upper: phi_O, N. thickness: H, m.\n"
           "obliquity: beta, rad. Raises ConfigurationError.");
  def_value(law, {"depth", "lower", "upper", "thickness", "obliquity"});
  const Getters get{law};
  get("depth", "Of the knots, m", [](auto& l) { return shown_tuple(l.depth); });
  get("lower", "phi_I at the knots, N", [](auto& l) { return shown_tuple(l.lower); });
  get("upper", "phi_O at the knots, N", [](auto& l) { return shown_tuple(l.upper); });
  get("thickness", "H, m; 0 gives the profile itself", &GivenProfileLaw::thickness);
  get("obliquity", "beta, rad", &GivenProfileLaw::obliquity);
  law.def("weights", &weights, nb::arg("depth"),
          "The weights of the knots at depths (m) of any shape: bounds(depth)[0] is weights(depth) @ lower.\n\n"
          "Returns an array of shape depth.shape + (knots,). K06 (16)");
}

}  // namespace punctura::bindings
