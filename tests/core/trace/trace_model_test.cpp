// The force along a motion and its exact derivatives, also with relaxation, and the places where a wall pops.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "punctura/lab/trace/trace_model.hpp"

namespace {

using punctura::TraceCoupling;
using punctura::TraceMembrane;

constexpr punctura::Needle trace_needle{1.2e-3, 0.4};
constexpr TraceMembrane trace_k06{5.0137e-3, 600, 0.3, 0.2, 0.5e-3, 0, 0, 0, 1, 0, 0};
constexpr TraceMembrane trace_tissue{6.0137e-3, 300, 0.1, 0.3, 1e-3, 400, 2e-3, 0.8e-3, 0.6, 0.3, 0.2};
/// The tip has passed most of the wall when it leaves, and goes deeper afterwards.
constexpr TraceMembrane trace_thick{6.0137e-3, 300, 0.1, 0.3, 8e-3, 400, 2e-3, 0.8e-3, 0.6, 0.3, 0.2};

struct TraceRun {
  std::vector<double> depth, time;

  TraceRun() {
    for (int i = 0; i < 1100; ++i) {  // in, a rest, out, in again deeper
      const double x = i < 300 ? i : i < 400 ? 300 : i < 700 ? 700 - i : i - 700;
      depth.push_back(5e-5 * x);
      time.push_back(0.01 * i);
    }
  }
  std::vector<double> force(const TraceMembrane& m, const TraceCoupling& c, std::vector<double>* rows = nullptr) const {
    std::vector<double> f(depth.size());
    if (rows != nullptr) rows->resize(depth.size() * punctura::trace_parameters(1));
    punctura::trace_forces({trace_needle, depth, time}, std::vector{m}, c, f,
                           rows == nullptr ? std::span<double>{} : std::span<double>(*rows));
    return f;
  }
};

/// The share of samples whose derivative by one parameter differs from the central difference.
double trace_share_of_wrong(const TraceRun& run, const TraceMembrane& membrane, const TraceCoupling& coupling,
                            std::size_t i) {
  std::vector<double> rows;
  run.force(membrane, coupling, &rows);
  const auto moved = [&](double step) {
    TraceMembrane m = membrane;
    TraceCoupling c = coupling;
    (i < c.size() ? c[i] : m[i - c.size()]) += step;
    return run.force(m, c);
  };
  const double value = i < coupling.size() ? coupling[i] : membrane[i - coupling.size()], step = 1e-6 * value;
  const auto ahead = moved(step), behind = moved(-step);
  double largest = 0, wrong = 0;
  for (std::size_t k = 0; k < ahead.size(); ++k)
    largest = std::max(largest, std::abs(ahead[k] - behind[k]) / (2 * step));
  for (std::size_t k = 0; k < ahead.size(); ++k) {
    const double difference = (ahead[k] - behind[k]) / (2 * step);
    wrong += std::abs(difference - rows[k * punctura::trace_parameters(1) + i]) > 2e-6 * largest ? 1 : 0;
  }
  return wrong / static_cast<double>(ahead.size());
}

}  // namespace

TEST_CASE("derivatives along a trace are those of central differences" * doctest::test_suite("numbers")) {
  const TraceRun run;
  const TraceCoupling stiff{3000, 0.5, 0, 1, 0, 1}, relaxing{2000, 0.5, 800, 0.6, 400, 5};
  for (const TraceMembrane& membrane : {trace_k06, trace_tissue, trace_thick})
    for (const TraceCoupling& coupling : {stiff, relaxing})
      for (std::size_t i = 0; i < punctura::trace_parameters(1); ++i) {
        const double value = i < 6 ? coupling[i] : membrane[i - 6];
        if (value == 0 || (i < 6 && i > 1 && coupling[2] == 0) || (i == 14 && value == 1)) continue;
        CAPTURE(i);
        CHECK(trace_share_of_wrong(run, membrane, coupling, i) < 0.03);  // corners have two derivatives
      }
}

TEST_CASE("values without derivatives are the same forces") {
  const TraceRun run;
  std::vector<double> rows;
  const TraceCoupling relaxing{2000, 0.5, 800, 0.6, 0, 1};
  const auto with = run.force(trace_tissue, relaxing, &rows), without = run.force(trace_tissue, relaxing);
  for (std::size_t k = 0; k < with.size(); ++k) CHECK(with[k] == doctest::Approx(without[k]).epsilon(1e-12));
}

TEST_CASE("the force of a hold relaxes to the spring's own") {
  const TraceRun run;
  const auto force = run.force(trace_k06, {4000, 0, 2000, 0.1, 0, 1});
  CHECK(force[399] < force[299] + 1e-12);
  CHECK(force[399] > 0);
}

TEST_CASE("the force is a continuous function of the surface, also at the pop" * doctest::test_suite("numbers")) {
  const TraceRun run;
  TraceMembrane moved = trace_k06;
  moved[4] = 0.1e-3;
  auto before = run.force(moved, {1500, 0, 0, 1, 0, 1});
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    moved[0] += 2.5e-7;
    const auto now = run.force(moved, {1500, 0, 0, 1, 0, 1});
    for (std::size_t k = 0; k < now.size(); ++k) largest = std::max(largest, std::abs(now[k] - before[k]));
    before = now;
  }
  CHECK(largest < 0.01);  // the pop drops by 0.4 N
}

TEST_CASE("a slow needle pops at the depth that trace_pop tells") {
  const TraceCoupling soft{1500, 0, 0, 1, 0, 1};
  TraceMembrane membrane = trace_k06;
  membrane[4] = 0.1e-3;
  const auto pop = punctura::trace_pop(trace_needle, membrane, soft);
  std::vector<double> depth, force(4000);
  for (std::size_t i = 0; i < force.size(); ++i) depth.push_back(4.9e-3 + 1e-6 * static_cast<double>(i));
  punctura::trace_forces({trace_needle, depth, {}}, std::vector{membrane}, soft, force, {});
  std::size_t at = 1;
  for (std::size_t i = 1; i < force.size(); ++i)
    if (force[i - 1] - force[i] > force[at - 1] - force[at]) at = i;
  CHECK(depth[at] == doctest::Approx(membrane[0] + pop.value).epsilon(2e-4));
  const auto steeper = punctura::trace_pop(trace_needle, membrane, {1501.5, 0, 0, 1, 0, 1});
  CHECK((steeper.value - pop.value) / 1.5 == doctest::Approx(pop.d[0]).epsilon(2e-3));
}
