// Measures all methods of position conditioning. Prints one JSON object for ../conditioning.py, which builds and runs
// it.
#include <chrono>
#include <cstdio>

#include "closed_loop.hpp"
#include "methods.hpp"
#include "motion.hpp"
#include "rest.hpp"

namespace {

using namespace bench;
using punctura::Solver;

/// Time per position (three axes) in a motion with tremor: the minimum of nine runs, ns.
double cost(const Method& method) {
  using Clock = std::chrono::steady_clock;
  constexpr int ticks = 16000;
  double least = 1e9, kept = 0;
  for (int run = 0; run < 9; ++run) {
    const Filter filter = method.make();
    std::vector<Vector3d> path(ticks);
    for (int k = 0; k < ticks; ++k) {
      const double y = 5e-3 * std::sin(5e-3 * k) + 1e-4 * std::sin(0.04 * k);
      path[static_cast<std::size_t>(k)] = {encoder(y), encoder(0.7 * y), encoder(0.2 * y)};
    }
    const auto begin = Clock::now();
    for (const Vector3d& p : path) kept += filter(p)[1];
    least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / ticks);
  }
  return kept == 0.123 ? 0 : least;
}

void number(const char* name, double value) { std::printf(", \"%s\": %.5g", name, value); }

void measure(const Method& method, double paper_delay) {
  std::printf("{\"name\": \"%s\", \"note\": \"%s\"", method.name.c_str(), method.note.c_str());
  for (const Solver solver : {Solver::exact, Solver::paper}) {
    const char* prefix = solver == Solver::exact ? "exact" : "paper";
    const auto put = [&](const std::string& name, double value) { number((prefix + ("_" + name)).c_str(), value); };
    put("rest_toggle_N", rest_noise(method, Dither::toggle, Axes::along, solver).norm);
    put("rest_two_N", rest_noise(method, Dither::two, Axes::along, solver).norm);
    put("rest_three_N", rest_noise(method, Dither::three, Axes::along, solver).norm);
    put("rest_across_N", rest_noise(method, Dither::three, Axes::across, solver).norm);
    const RestNoise all = rest_noise(method, Dither::three, Axes::all, solver);
    put("rest_all_N", all.norm);
    put("rest_all_along_N", all.along);
    for (const auto& [name, rest] : {std::pair{"omni", omni(method, solver)},
                                     {"trembling", trembling(method, solver)},
                                     {"frictionless", frictionless(method, solver)}}) {
      put(std::string(name) + "_tick_N", rest.tick);
      put(std::string(name) + "_speed_m_per_s", rest.speed);
      put(std::string(name) + "_creep_m", rest.creep);
    }
  }
  const Pop exact = pop_error(method, 0.1e-3, Solver::exact), paper = pop_error(method, 0.1e-3, Solver::paper);
  number("exact_pop_error", exact.size);
  number("exact_fall_error", exact.tick);
  number("paper_pop_error", paper.size);
  const double lag = delay(method, 10e-3);
  number("delay_s", lag);
  number("added_delay_s", lag - paper_delay);
  number("creep_N", creep(method, Dither::three));
  for (const auto& [name, speed] : {std::pair{"slow", 1e-3}, {"brisk", 10e-3}}) {
    const Ripple r = ripple(method, speed);
    number((std::string(name) + "_tick_N").c_str(), r.tick);
    number((std::string(name) + "_worst_N").c_str(), r.worst);
  }
  number("loop_counts", loop_width(method));
  number("stroke_counts", stroke_error(method));
  number("stop_10_counts", overshoot(method, 10e-3));
  number("stop_200_counts", overshoot(method, 0.2));
  number("largest_stiffness_N_per_m", largest_stiffness(method));
  number("cost_ns", cost(method));
  std::printf("}");
  std::fflush(stdout);
}

}  // namespace

int main() {
  const auto all = methods();
  const double paper_delay = delay(all[1], 10e-3);
  std::printf("{\"compiler\": \"%s\", \"flags\": \"%s\", \"count_m\": %g, \"methods\": [\n", BENCH_COMPILER,
              BENCH_FLAGS, count);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) std::printf(",\n");
    measure(all[i], paper_delay);
    std::fprintf(stderr, ".");
  }
  std::printf("\n]}\n");
  std::fprintf(stderr, "\n");
}
