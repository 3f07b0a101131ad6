// core/punctura/lab/trace/live_estimate.hpp: slope, friction and punctures while a run goes on.
#include "punctura/lab/trace/live_estimate.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include "bindings.hpp"
#include "state.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

struct GivenLiveEstimate : LiveEstimate, OneThread {
  explicit GivenLiveEstimate(const LiveSettings& given) : LiveEstimate(given) {}

  std::vector<std::byte> save() const { return save_state<LiveEstimate>(*this); }
  bool load(std::span<const std::byte> state) { return load_state<LiveEstimate>(*this, state); }
  nb::tuple arguments() const {
    const LiveSettings& s = settings();
    return nb::make_tuple(s.puncture.noise, s.puncture.least_drop, s.puncture.least_share, s.puncture.least_speed,
                          s.puncture.unloading, s.contact, s.step, s.rise_memory);
  }
};

LiveSettings checked(double noise, double least_drop, double least_share, double least_speed, double unloading,
                     double contact, double step, double rise_memory) {
  const Range above{0, no_bound, true, true, "must be greater than 0"},
      from{0, no_bound, false, true, "must be 0 or more"},
      share{0, 1, false, true, "must be at least 0 and less than 1"};
  std::vector<Problem> problems;
  check_field({"noise", "", "N", above}, noise, "live_estimate", problems);
  check_field({"least_drop", "", "N", above}, least_drop, "live_estimate", problems);
  check_field({"least_share", "", "-", share}, least_share, "live_estimate", problems);
  check_field({"least_speed", "", "m/s", above}, least_speed, "live_estimate", problems);
  check_field({"unloading", "", "N/m", from}, unloading, "live_estimate", problems);
  check_field({"contact", "", "N", above}, contact, "live_estimate", problems);
  check_field({"step", "", "m", above}, step, "live_estimate", problems);
  check_field({"rise_memory", "", "m", above}, rise_memory, "live_estimate", problems);
  raise_if(problems);
  return {{.noise = noise,
           .least_drop = least_drop,
           .least_share = least_share,
           .least_speed = least_speed,
           .unloading = unloading},
          step,
          rise_memory,
          contact};
}

const char* word(LivePhase phase) {
  return phase == LivePhase::free ? "free" : phase == LivePhase::rise ? "rise" : "behind";
}

std::optional<std::tuple<double, double>> pair(const LiveValue& v) {
  if (std::isnan(v.value)) return std::nullopt;
  return std::tuple(v.value, v.error);
}

Columns run(GivenLiveEstimate& self, const ArrayLike& depths, const ArrayLike& forces, double period) {
  const Input depth = input_1d(depths, "depth"), force = input_1d(forces, "force");
  const std::size_t n = depth.size();
  if (force.size() != n) throw nb::value_error("force must have one value for each depth");
  if (!(period > 0 && std::isfinite(period))) throw nb::value_error("period must be greater than 0 s");
  std::vector<double> slope(n), slope_error(n), plateau(n), plateau_error(n);
  std::vector<std::uint8_t> phase(n), punctured(n);
  const OneThread::Running running(self);
  make_ticks(n, [&](std::size_t i) {
    const LiveReading& r = self.step(depth.data()[i], force.data()[i], period);
    slope[i] = r.slope.value;
    slope_error[i] = r.slope.error;
    plateau[i] = r.plateau.value;
    plateau_error[i] = r.plateau.error;
    phase[i] = static_cast<std::uint8_t>(r.phase);
    punctured[i] = r.punctured ? 1 : 0;
  });
  nb::dict all;
  all["phase"] = to_numpy(std::move(phase), {n});
  all["slope"] = to_numpy(std::move(slope), {n});
  all["slope_error"] = to_numpy(std::move(slope_error), {n});
  all["plateau"] = to_numpy(std::move(plateau), {n});
  all["plateau_error"] = to_numpy(std::move(plateau_error), {n});
  all["punctured"] = to_numpy(std::move(punctured), {n}).attr("view")("bool");
  return all;
}

}  // namespace

void bind_live_estimate(nb::module_& m) {
  const LiveSettings usual;
  auto live = nb::class_<GivenLiveEstimate>(
      m, "LiveEstimate", nb::is_final(),
      "While a run goes on: the slope of the membrane in contact, the friction behind it, and punctures. From depth\n"
      "and force alone, tick by tick. The standard deviations are those of noise about a straight line: where\n"
      "the force is curved, that of a slope is some 1.5 times too large. docs/live-estimate.md");
  def_state(live);
  def_reset(live, "Forgets everything.");
  def_repr(live, "<LiveEstimate: {0.phase}, {0.punctures} punctures>");
  live.def(
          "__init__",
          [](GivenLiveEstimate* self, double noise, double least_drop, double least_share, double least_speed,
             double unloading, double contact, double step, double rise_memory) {
            new (self) GivenLiveEstimate(
                checked(noise, least_drop, least_share, least_speed, unloading, contact, step, rise_memory));
          },
          nb::arg("noise") = usual.puncture.noise, nb::arg("least_drop") = usual.puncture.least_drop,
          nb::arg("least_share") = usual.puncture.least_share, nb::arg("least_speed") = usual.puncture.least_speed,
          nb::arg("unloading") = usual.puncture.unloading, nb::arg("contact") = usual.contact,
          nb::arg("step") = usual.step, nb::arg("rise_memory") = usual.rise_memory,
          "noise: smallest standard deviation of the force from tick to tick, N. least_drop: of a puncture, N.\n"
          "least_share: least drop over the force before it. least_speed: slower needles make no puncture, m/s.\n"
          "unloading: largest stiffness of a tissue that unloads, N/m. contact: force of a membrane in contact, N.\n"
          "step: way over which ticks are averaged, m. rise_memory: the slope is that of about this way, m. Raises\n"
          "ConfigurationError.")
      .def(
          "step",
          [](GivenLiveEstimate& self, double depth, double force, double period) {
            self.must_rest();
            return self.LiveEstimate::step(depth, force, period).punctured;
          },
          nb::arg("depth"), nb::arg("force"), nb::arg("period"),
          "Makes one tick. Returns True in the tick in which a puncture is found.\n\n"
          "depth: m, growing inwards. force: N, against the insertion. period: s. A sample that is no finite number\n"
          "is left out and counted in `ignored`.")
      .def("run", &run, nb::arg("depth"), nb::arg("force"), nb::arg("period"),
           "Makes n ticks. Returns phase (0 free, 1 rise, 2 behind), slope, slope_error, plateau, plateau_error and\n"
           "punctured after each, (n,); NaN while unknown. Errors are standard deviations. Raises ValueError.")
      .def_prop_ro("phase",
                   resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return word(s.reading().phase); }),
                   nb::sig("def phase(self) -> typing.Literal['free', 'rise', 'behind']"),
                   "\"free\": no force yet. \"rise\": a membrane in contact. \"behind\": behind a puncture.")
      .def_prop_ro("slope",
                   resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return pair(s.reading().slope); }),
                   "Slope of the force of the membrane in contact and its standard deviation, N/m")
      .def_prop_ro("plateau",
                   resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return pair(s.reading().plateau); }),
                   "Friction behind the last puncture and its standard deviation, N")
      .def_prop_ro("punctures",
                   resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return s.reading().punctures; }),
                   "How many were found")
      .def_prop_ro("drop", resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return s.reading().drop; }),
                   "Of the last puncture so far, N")
      .def_prop_ro("puncture_depth",
                   resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return s.reading().puncture_depth; }),
                   "Depth of the last puncture, m; NaN before the first")
      .def_prop_ro("ignored", resting<GivenLiveEstimate>([](const GivenLiveEstimate& s) { return s.ignored(); }),
                   "Samples that were left out");
}

}  // namespace punctura::bindings
