// core/punctura/proxy and insertion: the discrete-time systems of K06 section 3, for one membrane and for a scene.

#include <nanobind/stl/variant.h>

#include "bindings.hpp"
#include "punctura/insertion/insertion.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/check.hpp"
#include "run_in_space.hpp"
#include "struct.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

void check_coupling(const Coupling& coupling, double period, std::vector<Problem>& problems) {
  check(coupling, problems);
  check_period(period, problems);
}

/// The laws of a proxy on a line: the one list of them.
using GivenLaw = std::variant<GivenThinLaw, GivenThickLaw, GivenProfileLaw, GivenTissueLaw>;

/// One Python class for proxies with either law. It keeps its constructor arguments.
class LineProxy : public OneThread {
 public:
  LineProxy(GivenLaw law, const Coupling& coupling, double period, Solver solver)
      : law_(std::move(law)), coupling_(coupling), period_(period), solver_(solver), proxy_(made()) {}

  template <typename Function>
  auto read(Function&& function) const {
    return std::visit(function, proxy_);
  }
  void reset() {
    std::visit([](auto& proxy) { proxy.reset(); }, proxy_);
  }
  double step(double depth) {
    must_rest();
    check_places(&depth, 1, "p");
    return std::visit([&](auto& proxy) { return proxy.step(depth); }, proxy_);
  }
  double peek(double depth) const {
    must_rest();
    check_places(&depth, 1, "p");
    return read([&](auto proxy) { return proxy.step(depth); });
  }
  TicksObject run(const ArrayLike& depths, const ProgressArgument& progress) {
    TickColumns columns({"position", "force", "depth", "axial_force", "lower", "upper", "proxy", "phase"});
    columns.reserve(nb::len_hint(depths), 1);  // before the depths are copied
    const Input p = input_1d(depths, "p");
    check_places(p.data(), p.size(), "p", 1);
    Snapshot record{};
    record.membrane_count = 1;
    const Running running(*this);
    const auto make_all = [&](auto& proxy) {
      const auto tick = [&](std::size_t i) {
        record.sample.position = {p.data()[i], 0, 0};
        record.force = {proxy.step(p.data()[i]), 0, 0};
        record.membranes[0] = record_of(proxy.tick());
        columns.add(record);
      };
      make_ticks(p.size(), tick, progress);
    };
    std::visit(make_all, proxy_);
    return columns.to_ticks(1, true);
  }

  std::vector<std::byte> save() const {
    return read([](const auto& proxy) { return save_state(proxy); });
  }
  bool load(std::span<const std::byte> state) {
    return std::visit([&](auto& proxy) { return load_state(proxy, state); }, proxy_);
  }
  nb::tuple arguments() const { return nb::make_tuple(law_, coupling_, period_, Word(solver_)); }

 private:
  template <typename... Given>
  static std::variant<Proxy1d<typename Given::Law>...> proxies_of(const std::variant<Given...>&);
  using Proxies = decltype(proxies_of(std::declval<GivenLaw>()));
  Proxies made() const {
    return std::visit(
        [&]<typename Given>(const Given& law) -> Proxies {
          return Proxy1d<typename Given::Law>(law, coupling_, period_, solver_);
        },
        law_);
  }

  GivenLaw law_;
  Coupling coupling_;
  double period_;
  Solver solver_;
  Proxies proxy_;
};

struct SpaceArguments {
  Needle needle;
  Membrane membrane;
  Triple point, inward_normal;
  Coupling coupling;
  double period;
  Solver solver = Solver::exact;
};
constexpr std::tuple space_rows{
    row("needle", &SpaceArguments::needle),
    row("membrane", &SpaceArguments::membrane),
    row("point", &SpaceArguments::point, "a, any point of the surface, m."),
    row("inward_normal", &SpaceArguments::inward_normal, "Direction of any length but 0."),
    row("coupling", &SpaceArguments::coupling),
    row("period", &SpaceArguments::period, "T, s."),
    row("solver", &SpaceArguments::solver),
};

/// A proxy in space that keeps its constructor arguments.
struct SpaceProxy : Proxy3d<ThickLaw>, OneThread {
  explicit SpaceProxy(const SpaceArguments& a)
      : Proxy3d(ThickLaw(a.needle, a.membrane), to_vector(a.point), unit(a.inward_normal, "inward_normal"), a.coupling,
                a.period, a.solver),
        given(a) {}
  SpaceArguments given;

  nb::tuple arguments() const { return StructOf<space_rows>::arguments(given); }
};

LineProxy make_line(GivenLaw law, Coupling coupling, double period, const Word<Solver>& solver) {
  std::vector<Problem> problems;
  check_coupling(coupling, period, problems);
  raise_if(problems);
  return {std::move(law), coupling, period, solver.at("solver")};
}

}  // namespace

void bind_proxy(nb::module_& m) {
  def_words<Phase>(
      m, "Phase", "The state of the needle in one membrane.",
      {"In front of the membrane. No force.", "The proxy rests. The force is inside the band.",
       "The force is on the lower edge.", "The force is on the upper edge.",
       "Inside without having entered from the front. No force until the tip has been outside, in front."});

  def_struct<coupling_fields>(
      m, {"Coupling", "The virtual coupling: spring and damper between device and proxy. K06 (21)", "coupling"});

  auto line =
      nb::class_<LineProxy>(m, "Proxy1d", nb::is_final(), "The proxy on the axis of the needle. K06 section 3.1, (33)");
  def_init(line, &make_line, nb::arg("law"), nb::arg("coupling"), nb::arg("period"), nb::arg("solver") = "exact",
           "period: T, s. solver: \"exact\" or \"paper\". Raises ConfigurationError.");
  def_state(line);
  def_reset(line);
  def_repr(line, "<Proxy1d {0.phase.name}: depth {0.depth:g} m, force {0.force:g} N>");
  line.def("step", &LineProxy::step, nb::arg("p"),
           "Makes one tick. p: depth of the device, m. Returns the force on the device, N. Raises ValueError.")
      .def("peek", &LineProxy::peek, nb::arg("p"), "The force of step(p), without changing the state.")
      .def("run", &LineProxy::run, nb::arg("p"), nb::kw_only(), nb::arg("progress") = nb::none(),
           "Makes n ticks from the present state on. p (n,): depths, m.\n\n"
           "Returns position, force, depth, axial_force, lower, upper, proxy and phase, each (n,). Raises ValueError.\n"
           "progress and Ctrl-C: see Insertion.run.");
  const auto of_line = [get = Getters(line)](const char* name, const char* doc, auto read) {
    get(name, doc, [read](const LineProxy& p) { return p.read(read); });
  };
  of_line("force", "f(k), N", [](auto& p) { return p.force(); });
  of_line("offset", "e(k) = q(k) - p(k), m", [](auto& p) { return p.offset(); });
  of_line("position", "q(k), m", [](auto& p) { return p.position(); });
  of_line("depth", "The depth at which the band was evaluated, m: q(k), or q*(k) with the paper's solver",
          [](auto& p) { return p.depth(); });
  of_line("phase", "", [](auto& p) { return p.phase(); });

  auto space =
      nb::class_<SpaceProxy>(m, "Proxy3d", nb::is_final(), "The proxy of one membrane in space. K06 section 3.2, (41)");
  StructOf<space_rows>::def_init(space, {.needed = 6}, [](const SpaceArguments& made, std::vector<Problem>& problems) {
    problems = problems_of(made.needle, made.membrane);
    check_coupling(made.coupling, made.period, problems);
    if (!to_vector(made.point).allFinite())
      problems.push_back({"point", detail::value_to_show(made.point), "must be three finite numbers"});
  });
  def_state(space);
  def_reset(space,
            "Resets to the state before the first tick. A start inside gives no force until the tip has been "
            "outside.");
  def_repr(space, "<Proxy3d {0.phase.name}: depth {0.depth:g} m, force {0.force} N>");
  def_steps_in_space<Proxy3d<ThickLaw>>(space);
  def_run_in_space(
      space, {"position", "axis", "force", "depth", "axial_force", "lower", "upper", "proxy", "direction", "phase"},
      "Makes n ticks from the present state on.\n\n"
      "p (n, 3): positions, m. axis (n, 3) or (3,): directions of any length but 0. Returns position, axis,\n"
      "force, proxy, direction (n, 3), and depth, axial_force, lower, upper, phase (n,). Raises ValueError.\n"
      "progress and Ctrl-C: see Insertion.run.");
  const Getters get{space};
  get("force", "f(k), N", [](auto& p) { return to_array(p.force()); });
  get("offset", "e(k) = q(k) - p(k), m", [](auto& p) { return to_array(p.offset()); });
  get("position", "q(k), m", [](auto& p) { return to_array(p.position()); });
  get("direction", "b, the direction at entry, kept while inside", [](auto& p) { return to_array(p.direction()); });
  get("axial_force", "b.f(k), N", &SpaceProxy::axial_force);
  get("depth", "Depth, m. Inside along b: of q(k), or of q*(k) with the paper's solver. Outside along the normal",
      &SpaceProxy::depth);
  get("bounds", "The band of the axial force, (lower, upper), N; (0, 0) outside",
      [](auto& p) { return std::array{p.band().lower, p.band().upper}; });
  get("phase", "", &SpaceProxy::phase);
}

namespace {

/// An insertion that keeps its scene.
struct SceneInsertion : Insertion, OneThread {
  explicit SceneInsertion(Scene given) : Insertion(build_insertion(given)), scene(std::move(given)) {}
  Scene scene;

  nb::tuple arguments() const { return nb::make_tuple(scene); }
};

template <typename Get>
auto of_membranes(const SceneInsertion& insertion, Get get) {
  std::vector<decltype(get(insertion.tick(0)))> values;
  for (std::size_t i = 0; i < insertion.size(); ++i) values.push_back(get(insertion.tick(i)));
  return shown_tuple(values);
}

}  // namespace

void bind_insertion(nb::module_& m) {
  auto insertion = nb::class_<SceneInsertion>(
      m, "Insertion", nb::is_final(),
      "A needle through all membranes of a scene: position conditioning and the sum of one proxy per membrane. K06\n"
      "(41), Fig. 8\n\n"
      "Gives the model's force without safety limits.");
  def_state(insertion);
  def_reset(insertion);
  def_repr(insertion, "<Insertion in {0.scene.name!r}: tip {0.tip} m, force {0.force} N>");
  insertion.def(nb::init<Scene>(), nb::arg("scene"), "Raises ConfigurationError with all problems of the scene.");
  def_steps_in_space<Insertion>(insertion);
  insertion.def_ro("scene", &SceneInsertion::scene);
  def_run_in_space(
      insertion,
      {"position", "axis", "tip", "force", "depth", "axial_force", "lower", "upper", "proxy", "direction", "phase"},
      "Makes n ticks from the present state on.\n\n"
      "p (n, 3): positions, m. axis (n, 3) or (3,): directions of any length but 0. Raises ValueError.\n"
      "progress: a function of the finished share, 0 to 1, or True for a bar. After Ctrl-C some\n"
      "ticks were made and are lost; `state` goes back to an earlier tick.");
  const Getters get{insertion};
  get("depths", "Depth of the proxy behind each membrane, last tick, m",
      [](auto& i) { return of_membranes(i, [](const auto& tick) { return tick.depth; }); });
  get("phases", "Phase at each membrane in the last tick",
      [](auto& i) { return of_membranes(i, [](const auto& tick) { return tick.phase; }); });
  get("tip", "The conditioned position, m", [](auto& i) { return to_array(i.tip()); });
  get("force", "The force of the last tick, N", [](auto& i) { return to_array(i.force()); });
}

}  // namespace punctura::bindings
