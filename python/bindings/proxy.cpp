// core/punctura/proxy: the discrete-time systems of K06 section 3, one membrane.
#include "punctura/proxy/proxy_3d.hpp"

#include "bindings.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/check.hpp"
#include "value.hpp"

#include <nanobind/stl/variant.h>

namespace punctura::bindings {
namespace {

void check_coupling(const Coupling& coupling, double period, std::vector<Problem>& problems) {
  check_field(coupling_fields[0], coupling.stiffness, "coupling", problems);
  check_field(coupling_fields[1], coupling.damping, "coupling", problems);
  if (!(period > 0 && std::isfinite(period))) problems.push_back({"period", period, "must be greater than 0 s"});
}

/// One Python class for proxies on either law.
class AnyProxy1d {
 public:
  using Thin = Proxy1d<ThinLaw>;
  using Thick = Proxy1d<ThickLaw>;

  AnyProxy1d(const std::variant<ThinLaw, ThickLaw>& law, const Coupling& coupling, double period, Solver solver)
      : proxy_(std::visit(
            [&](const auto& l) -> std::variant<Thin, Thick> { return Proxy1d(l, coupling, period, solver); }, law)) {}

  template <typename Function>
  auto visit(Function&& function) {
    return std::visit(function, proxy_);
  }

  nb::object run(const nb::object& depths) {
    const Input p = input_1d(depths, "p");
    std::vector<double> f(p.size());
    {
      nb::gil_scoped_release release;
      visit([&](auto& proxy) {
        for (std::size_t i = 0; i < f.size(); ++i) f[i] = proxy.step(p.data()[i]);
      });
    }
    return to_numpy(std::move(f), {p.size()});
  }

 private:
  std::variant<Thin, Thick> proxy_;
};

using Proxy = Proxy3d<ThickLaw>;

nb::object run_3d(Proxy& proxy, const nb::object& positions, const nb::object& axis) {
  const Input p = points(positions, "p");
  const std::size_t n = p.shape(0);
  const Rows axes(input(axis), n, "axis");
  std::vector<double> f(3 * n);
  {
    nb::gil_scoped_release release;
    for (std::size_t i = 0; i < n; ++i) {
      const double* row = p.data() + 3 * i;
      const Vector3d now = proxy.step({row[0], row[1], row[2]}, axes[i].stableNormalized());
      std::copy(now.begin(), now.end(), &f[3 * i]);
    }
  }
  return to_numpy(std::move(f), {n, 3});
}

}  // namespace

void bind_proxy(nb::module_& m) {
  nb::enum_<Phase>(m, "Phase", nb::is_arithmetic(), "What the needle is doing in one membrane.")
      .value("outside", Phase::outside)
      .value("sticking", Phase::sticking, "The proxy rests: the force is inside the band.")
      .value("sliding_in", Phase::sliding_in, "The force is on the lower edge.")
      .value("sliding_out", Phase::sliding_out, "The force is on the upper edge.")
      .value("barred", Phase::barred,
             "Inside, but not entered from the front: no force until the tip has been outside, in front.");

  auto coupling =
      nb::class_<Coupling>(m, "Coupling", "The virtual coupling: spring and damper between device and proxy. K06 (21)")
          .def(nb::init<double, double>(), nb::arg("stiffness"), nb::arg("damping"))
          .def_ro("stiffness", &Coupling::stiffness, "K, N/m")
          .def_ro("damping", &Coupling::damping, "B, N s/m");
  def_value(coupling, {"stiffness", "damping"});

  nb::class_<AnyProxy1d>(m, "Proxy1d", "The proxy on the axis of the needle. K06 section 3.1, (33)")
      .def(
          "__init__",
          [](AnyProxy1d* self, const std::variant<ThinLaw, ThickLaw>& law, const Coupling& coupling, double period,
             const std::string& solver) {
            std::vector<Problem> problems;
            check_coupling(coupling, period, problems);
            raise_if(problems);
            new (self) AnyProxy1d(law, coupling, period, solver_from(solver));
          },
          nb::arg("law"), nb::arg("coupling"), nb::arg("period"), nb::arg("solver") = "exact",
          "period: T, s. solver: \"exact\" or \"paper\". Raises ConfigurationError.")
      .def(
          "reset", [](AnyProxy1d& p) { p.visit([](auto& x) { x.reset(); }); }, "Forgets all motion.")
      .def(
          "step", [](AnyProxy1d& p, double depth) { return p.visit([&](auto& x) { return x.step(depth); }); },
          nb::arg("p"), "One tick: p, the device's depth (m), gives the force on the device (N).")
      .def("run", &AnyProxy1d::run, nb::arg("p"),
           nb::sig("def run(self, p: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
           "Many ticks, from the present state on: p (n,), m, gives f (n,), N.")
      .def_prop_ro(
          "force", [](AnyProxy1d& p) { return p.visit([](auto& x) { return x.force(); }); }, "f(k), N")
      .def_prop_ro(
          "offset", [](AnyProxy1d& p) { return p.visit([](auto& x) { return x.offset(); }); }, "e(k) = q(k) - p(k), m")
      .def_prop_ro(
          "position", [](AnyProxy1d& p) { return p.visit([](auto& x) { return x.position(); }); }, "q(k), m")
      .def_prop_ro(
          "depth", [](AnyProxy1d& p) { return p.visit([](auto& x) { return x.depth(); }); },
          "Where the band was taken, m: q(k), or q*(k) with the paper's solver")
      .def_prop_ro("phase", [](AnyProxy1d& p) { return p.visit([](auto& x) { return x.phase(); }); });

  nb::class_<Proxy>(m, "Proxy3d", "The proxy of one membrane in space. K06 section 3.2, (41)")
      .def(
          "__init__",
          [](Proxy* self, const Needle& needle, const Membrane& membrane, const Triple& point,
             const Triple& inward_normal, const Coupling& coupling, double period, const std::string& solver) {
            std::vector<Problem> problems;
            const bool needle_good = check(needle, "needle", problems),
                       membrane_good = check(membrane, "membrane", problems);
            if (needle_good && membrane_good) check_insertion(needle, membrane, "membrane", problems);
            check_coupling(coupling, period, problems);
            if (!vector(point).allFinite())
              problems.push_back({"point", detail::offender(point), "must be three finite numbers"});
            raise_if(problems);
            new (self) Proxy(ThickLaw(needle, membrane), vector(point), unit(inward_normal, "inward_normal"), coupling,
                             period, solver_from(solver));
            self->reset();
          },
          nb::arg("needle"), nb::arg("membrane"), nb::arg("point"), nb::arg("inward_normal"), nb::arg("coupling"),
          nb::arg("period"), nb::arg("solver") = "exact",
          "point: a, any point of the surface, m. inward_normal: a direction of any length. period: T, s. Raises ConfigurationError.")
      .def("reset", &Proxy::reset, "Forgets all motion. A start inside gives no force until the tip has been outside.")
      .def(
          "step",
          [](Proxy& proxy, const Triple& p, const Triple& axis) {
            return plain(proxy.step(vector(p), vector(axis).stableNormalized()));
          },
          nb::arg("p"), nb::arg("axis"),
          "One tick: position p (m) and direction of the needle give the force on the device (N).")
      .def(
          "run", &run_3d, nb::arg("p"), nb::arg("axis"),
          nb::sig(
              "def run(self, p: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
          "Many ticks, from the present state on: p (n, 3), m; axis (n, 3) or (3,). Gives f (n, 3), N.")
      .def_prop_ro(
          "force", [](const Proxy& p) { return plain(p.force()); }, "f(k), N")
      .def_prop_ro(
          "offset", [](const Proxy& p) { return plain(p.offset()); }, "e(k) = q(k) - p(k), m")
      .def_prop_ro(
          "position", [](const Proxy& p) { return plain(p.position()); }, "q(k), m")
      .def_prop_ro(
          "direction", [](const Proxy& p) { return plain(p.direction()); }, "b, held from entry on")
      .def_prop_ro("axial_force", &Proxy::axial_force, "b.f(k), N")
      .def_prop_ro(
          "depth", &Proxy::depth,
          "Inside: along b, m, of q(k), or of q*(k) with the paper's solver. Else along the normal from the surface")
      .def_prop_ro(
          "bounds", [](const Proxy& p) { return std::array<double, 2>{p.band().lower, p.band().upper}; },
          "The band that bounds the axial force, (lower, upper), N; (0, 0) outside")
      .def_prop_ro("phase", &Proxy::phase);
}

}  // namespace punctura::bindings
