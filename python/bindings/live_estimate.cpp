// core/punctura/lab/trace/live_estimate.hpp: slope, friction and punctures while a run goes on.
#include "punctura/lab/trace/live_estimate.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include "bindings.hpp"
#include "state.hpp"
#include "struct.hpp"
#include "ticks.hpp"

namespace punctura::bindings {
namespace {

struct GivenLiveEstimate : LiveEstimate, OneThread {
  using LiveEstimate::LiveEstimate;
  nb::tuple arguments() const { return StructOf<live_fields>::arguments(settings()); }
};

std::optional<std::tuple<double, double>> pair(const LiveValue& v) {
  if (std::isnan(v.value)) return std::nullopt;
  return std::tuple(v.value, v.error);
}

Columns run(GivenLiveEstimate& self, const ArrayLike& depths, const ArrayLike& forces, double period) {
  const Input depth = input_1d(depths, "depth"), force = input_1d(forces, "force");
  if (force.size() != depth.size()) throw nb::value_error("force must have one value for each depth");
  if (!(period > 0 && std::isfinite(period))) throw nb::value_error("period must be greater than 0 s");
  std::vector<LiveReading> readings(depth.size());
  const OneThread::Running running(self);
  make_ticks(readings.size(),
             [&](std::size_t i) { readings[i] = self.step(depth.data()[i], force.data()[i], period); });
  nb::dict all;
  all["phase"] = column(readings, &LiveReading::phase);
  all["slope"] = column(readings, [](const LiveReading& r) { return r.slope.value; });
  all["slope_error"] = column(readings, [](const LiveReading& r) { return r.slope.error; });
  all["plateau"] = column(readings, [](const LiveReading& r) { return r.plateau.value; });
  all["plateau_error"] = column(readings, [](const LiveReading& r) { return r.plateau.error; });
  all["punctured"] = column(readings, &LiveReading::punctured);
  return all;
}

}  // namespace

void bind_live_estimate(nb::module_& m) {
  auto live = nb::class_<GivenLiveEstimate>(
      m, "LiveEstimate", nb::is_final(),
      "While a run goes on: the slope of the membrane in contact, the friction behind it, and punctures. From depth\n"
      "and force alone, tick by tick. The standard deviations are those of noise about a straight line: where\n"
      "the force is curved, that of a slope is some 1.5 times too large. docs/live-estimate.md");
  def_state(live);
  def_reset(live, "Forgets everything.");
  def_repr(live, "<LiveEstimate: {0.phase}, {0.punctures} punctures>");
  StructOf<live_fields>::def_init(live, {.path = "live_estimate"}, CheckNumbers());
  live.def(
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
           "punctured after each, (n,); NaN while unknown. Errors are standard deviations. Raises ValueError.");
  const Getters get{live};
  get("phase", "\"free\": no force yet. \"rise\": a membrane in contact. \"behind\": behind a puncture.",
      [](auto& s) { return Word(s.reading().phase); });
  get("slope", "Slope of the force of the membrane in contact and its standard deviation, N/m",
      [](auto& s) { return pair(s.reading().slope); });
  get("plateau", "Friction behind the last puncture and its standard deviation, N",
      [](auto& s) { return pair(s.reading().plateau); });
  get("punctures", "How many were found", [](auto& s) { return s.reading().punctures; });
  get("drop", "Of the last puncture so far, N", [](auto& s) { return s.reading().drop; });
  get("puncture_depth", "Depth of the last puncture, m; NaN before the first",
      [](auto& s) { return s.reading().puncture_depth; });
  get("ignored", "Samples that were left out", [](auto& s) { return s.ignored(); });
}

}  // namespace punctura::bindings
