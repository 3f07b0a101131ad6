// core/punctura/model: needle, membrane and the friction laws of K06 section 2.
#include "bindings.hpp"
#include "punctura/model/thick_law.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

/// Lower and upper edge over an array of depths of any shape.
template <typename L>
nb::tuple bounds(const L& law, const nb::object& depths) {
  const Input depth = input(depths);
  const std::size_t n = depth.size();
  std::vector<double> lower(n), upper(n);
  {
    nb::gil_scoped_release release;
    for (std::size_t i = 0; i < n; ++i) {
      const auto band = law.band(depth.data()[i]);
      lower[i] = band.lower;
      upper[i] = band.upper;
    }
  }
  const std::vector<std::size_t> shape(depth.shape_ptr(), depth.shape_ptr() + depth.ndim());
  return nb::make_tuple(to_numpy(std::move(lower), shape), to_numpy(std::move(upper), shape));
}

std::vector<Problem> problems_of(const Needle& needle, const Membrane& membrane) {
  std::vector<Problem> problems;
  const bool needle_good = check(needle, "needle", problems);
  const bool membrane_good = check(membrane, "membrane", problems);
  if (needle_good && membrane_good) check_insertion(needle, membrane, "membrane", problems);
  return problems;
}

template <typename L>
nb::class_<L> bind_law(nb::module_& m, const char* name, const char* doc) {
  return nb::class_<L>(m, name, doc)
      .def_prop_ro(
          "X", [](const L& l) { return l.constants().X; }, "Length of the tip, m. K06 (15)")
      .def_prop_ro(
          "A_I", [](const L& l) { return l.constants().A_I; }, "Growth of the insertion force, N/m. K06 (15)")
      .def_prop_ro(
          "A_O", [](const L& l) { return l.constants().A_O; },
          "Growth of the withdrawal force, N/m; negative where the membrane expels the tip. K06 (15)")
      .def_prop_ro(
          "Q", [](const L& l) { return l.constants().Q; }, "Precompression as a depth, m. K06 (15)")
      .def_prop_ro(
          "F", [](const L& l) { return l.constants().F; }, "Dry friction of the shaft, N. K06 (15)")
      .def(
          "bounds",
          [](const L& l, double q) {
            const auto b = l.band(q);
            return nb::make_tuple(b.lower, b.upper);
          },
          nb::arg("depth").noconvert(), nb::sig("def bounds(self, depth: float) -> tuple[float, float]"),
          "The band of static friction at one depth (m, along the needle): (lower, upper), N.")
      .def("bounds", &bounds<L>, nb::arg("depth"),
           nb::sig("def bounds(self, depth: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], "
                   "numpy.typing.NDArray[numpy.float64]]"),
           "The same for an array of depths of any shape. Returns (lower, upper) of that shape, N.");
}

}  // namespace

void bind_model(nb::module_& m) {
  auto needle = nb::class_<Needle>(m, "Needle", "A needle: diameter w (m) and tip angle theta (rad). K06 Fig. 1")
                    .def(nb::init<double, double>(), nb::arg("diameter"), nb::arg("tip_angle"))
                    .def_ro("diameter", &Needle::diameter, "w, m")
                    .def_ro("tip_angle", &Needle::tip_angle, "theta, rad");
  def_value(needle, {"diameter", "tip_angle"});

  auto membrane =
      nb::class_<Membrane>(m, "Membrane", "A membrane that grips the needle with dry friction. K06 section 2")
          .def(nb::init<double, double, double, double>(), nb::arg("stiffness"), nb::arg("precompression"),
               nb::arg("friction"), nb::arg("thickness"))
          .def_ro("stiffness", &Membrane::stiffness, "kappa, N/m")
          .def_ro("precompression", &Membrane::precompression, "c, N")
          .def_ro("friction", &Membrane::friction, "mu, -")
          .def_ro("thickness", &Membrane::thickness, "H, m; 0 is the thin law");
  def_value(membrane, {"stiffness", "precompression", "friction", "thickness"});

  bind_law<ThinLaw>(m, "ThinLaw", "Law of an infinitely thin membrane, crossed along its normal. K06 (13)(14)")
      .def(
          "__init__",
          [](ThinLaw* self, const Needle& needle, const Membrane& membrane) {
            raise_if(problems_of(needle, membrane));
            new (self) ThinLaw(needle, membrane);
          },
          nb::arg("needle"), nb::arg("membrane"), "Raises ConfigurationError with every bound that is broken.");

  bind_law<ThickLaw>(m, "ThickLaw", "Law of a membrane of thickness H, crossed at an obliquity beta. K06 (16)-(19)")
      .def(
          "__init__",
          [](ThickLaw* self, const Needle& needle, const Membrane& membrane, double obliquity) {
            auto problems = problems_of(needle, membrane);
            check_field(obliquity_field, obliquity, "", problems);
            raise_if(problems);
            new (self) ThickLaw(needle, membrane, obliquity);
          },
          nb::arg("needle"), nb::arg("membrane"), nb::arg("obliquity") = 0.0,
          "obliquity: beta, rad. Raises ConfigurationError with every bound that is broken.")
      .def_prop_ro("H", &ThickLaw::thickness, "Thickness, m")
      .def_prop_ro("U", &ThickLaw::path_length, "Length of the needle's path through the membrane, m. K06 (17)");
}

}  // namespace punctura::bindings
