// core/punctura/model: needle, membrane and tissue, and the friction laws of K06 section 2, of tissue and of profiles.
#include <cmath>
#include <numbers>

#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "state.hpp"
#include "struct.hpp"
#include "without_lock.hpp"

template <>
struct nb::detail::type_caster<punctura::GripPoint> : row_caster<punctura::GripPoint> {};
template <>
struct nb::detail::type_caster<punctura::Knot> : row_caster<punctura::Knot> {};

namespace punctura::bindings {
namespace {

/// Lower and upper edge of the band for an array of depths of any shape.
template <typename L>
nb::tuple bounds(const L& law, const nb::object& depths) {
  const Input depth = input(depths, "depth");
  const std::size_t n = depth.size();
  std::vector<double> lower(n), upper(n);
  {
    const WithoutLock release;
    for (std::size_t i = 0; i < n; ++i) {
      const auto band = law.band(depth.data()[i]);
      lower[i] = band.lower;
      upper[i] = band.upper;
    }
  }
  const std::vector<std::size_t> shape(depth.shape_ptr(), depth.shape_ptr() + depth.ndim());
  return nb::make_tuple(to_numpy(std::move(lower), shape), to_numpy(std::move(upper), shape));
}

/// Python's numbers, NumPy's, and arrays without a dimension.
bool is_one_number(const nb::object& value) {
  if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) return true;
  return nb::hasattr(value, "ndim") && nb::cast<int>(value.attr("ndim")) == 0;
}

template <typename L>
void def_bounds(nb::class_<L>& law) {
  law.def(
         "bounds",
         [](const L& l, const nb::object& q) {
           if (!is_one_number(q)) throw nb::next_overload();
           const auto b = l.band(nb::cast<double>(nb::float_(q)));
           return nb::make_tuple(b.lower, b.upper);
         },
         nb::arg("depth"),
         nb::sig("def bounds(self, depth: float | numpy.floating | numpy.integer) -> tuple[float, float]"),
         "The band of static friction at one depth (m, along the needle): (lower, upper), N.")
      .def("bounds", &bounds<L>, nb::arg("depth"),
           nb::sig("def bounds(self, depth: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], "
                   "numpy.typing.NDArray[numpy.float64]]"),
           "The same for an array of depths of any shape. Returns (lower, upper) of that shape, N.");
}

/// Adds the angle in radians to the problem of an angle that can be meant in degrees.
void suggest_radians(std::vector<Problem>& problems) {
  for (Problem& problem : problems) {
    if (problem.path != "needle.tip_angle" || !(problem.value > 0 && problem.value < 90)) continue;
    problem.reason += ". If you meant " + decimal_text(problem.value, 6) + " degrees, write " +
                      decimal_text(problem.value * std::numbers::pi / 180, 4) + ": the angle is in rad";
  }
}

constexpr auto needle_row = row("needle", &LawArguments::needle);
constexpr auto membrane_row = row("membrane", &LawArguments::membrane);
constexpr auto obliquity_row = row("obliquity", &LawArguments::obliquity, "beta, rad.");
constexpr std::tuple thin_rows{needle_row, membrane_row};
constexpr std::tuple thick_rows{needle_row, membrane_row, obliquity_row};
constexpr std::tuple tissue_law_rows{needle_row, membrane_row, row("tissue", &LawArguments::tissue), obliquity_row};

/// Defines the class of a law. needed: see ClassTexts.
template <const auto& rows, typename L>
auto bind_law(nb::module_& m, const char* name, const char* doc, int needed = 2,
              const char* raises = "Raises ConfigurationError with all problems.") {
  const auto check_all = [](const auto& made, std::vector<Problem>& problems) {
    problems = problems_of(made.needle, made.membrane);
    check_field(obliquity_field, made.obliquity, "", problems);
    if (check(made.tissue, "tissue", problems) && problems.empty())
      check_curve(made.needle, made.membrane, made.tissue, "tissue", problems);
  };
  auto law = def_struct<rows, L>(m, {.name = name, .doc = doc, .raises = raises, .needed = needed}, check_all);
  def_bounds(law);
  return law;
}
/// The same for one with K06's constants.
template <const auto& rows, typename L>
auto bind_k06_law(nb::module_& m, const char* name, const char* doc) {
  auto law = bind_law<rows, L>(m, name, doc);
  const Getters get{law};
  get("X", "Length of the tip, m. K06 (15)", [](auto& l) { return l.constants().X; });
  get("A_I", "Growth of the insertion force, N/m. K06 (15)", [](auto& l) { return l.constants().A_I; });
  get("A_O", "Growth of the withdrawal force, N/m; negative where the membrane expels the tip. K06 (15)",
      [](auto& l) { return l.constants().A_O; });
  get("Q", "Precompression as a depth, m. K06 (15)", [](auto& l) { return l.constants().Q; });
  get("F", "Dry friction of the shaft, N. K06 (15)", [](auto& l) { return l.constants().F; });
  return law;
}

GivenProfileLaw make_profile_law(std::vector<double> depth, std::vector<double> lower, std::vector<double> upper,
                                 double thickness, double obliquity) {
  std::vector<Problem> problems;
  const std::size_t n = depth.size();
  for (const auto& [name, values] : {std::pair{"lower", &lower}, std::pair{"upper", &upper}})
    if (values->size() != n)
      problems.push_back({std::string("len(") + name + ")", static_cast<double>(values->size()),
                          "must be the number of depths, " + std::to_string(n)});
  if (n == 0 || n > max_knots)
    problems.push_back({"len(depth)", static_cast<double>(n), "must be 1 to " + std::to_string(max_knots) + " knots"});
  const Field& H = field_of(membrane_fields, &Membrane::thickness);
  check_field(H, thickness, "", problems);
  check_field(obliquity_field, obliquity, "", problems);
  raise_if(problems);
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < n; ++i) knots.push_back({depth[i], lower[i], upper[i]});
  const auto path_of = [](std::size_t i, const std::string& field) { return field + "[" + std::to_string(i) + "]"; };
  check_profile(knots, "depth", path_of, problems);
  raise_if(problems);
  for (const auto& [name, unit, values] :
       {std::tuple{"depth", "m", &depth}, {"lower", "N", &lower}, {"upper", "N", &upper}})
    if (const auto found = unusual_list(std::string("profile[].") + name, *values)) {
      const std::string text = std::string(name) + " has " + decimal_text(found->first, 6) + " " + unit +
                               ", which is unusual. " + found->second + ": depths are in m, forces in N";
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw nb::python_error();
    }
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

void bind_model(nb::module_& m) {
  def_struct<needle_fields>(m, {"Needle", "A needle: diameter w (m) and tip angle theta (rad). K06 Fig. 1", "needle"},
                            [](const Needle& made, std::vector<Problem>& problems) {
                              check(made, "needle", problems);
                              suggest_radians(problems);
                            });
  def_struct<membrane_fields>(
      m, {"Membrane", "A membrane that grips the needle with dry friction. K06 section 2", "membrane"});

  bind_k06_law<thin_rows, GivenThinLaw>(m, "ThinLaw",
                                        "Law of an infinitely thin membrane, crossed along its normal. K06 (13)(14)");
  auto thick = bind_k06_law<thick_rows, GivenThickLaw>(
      m, "ThickLaw", "Law of a membrane of thickness H, crossed at an obliquity beta. K06 (16)-(19)");
  thick.def_prop_ro("H", &GivenThickLaw::thickness, "Thickness, m")
      .def_prop_ro("U", &GivenThickLaw::path_length, "Length of the needle's path through the membrane, m. K06 (17)");
}

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

void bind_tissue_law(nb::module_& m) {
  bind_law<tissue_law_rows, GivenTissueLaw>(
      m, "TissueLaw",
      "Law of a membrane of measured tissue. A proxy remembers its hole until it is reset.\n\n"
      "With Tissue() it is ThickLaw, bit for bit. docs/measured-tissue.md derives it.",
      3, "bounds() are those of an untouched wall. Raises ConfigurationError with all problems.")
      .def_prop_ro("X", &GivenTissueLaw::tip_length, "Length of the tip, m. K06 (15), or Tissue.tip_length");
}

}  // namespace punctura::bindings
