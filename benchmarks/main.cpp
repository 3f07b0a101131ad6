// The C++ measurements of ./bench. Prints one JSON object for run.py, which builds and runs this program.
//
//   bench_ticks [--seconds S] [--dump FILE]     S: seconds for each row of the table
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "contest_1d.hpp"
#include "contest_3d.hpp"
#include "contest_tissue.hpp"
#include "verify.hpp"

namespace {

using namespace bench;

struct Row {
  std::string form, scalar, motion;
  std::size_t membranes;
  std::vector<Contestant> contestants;
};

double seconds = 0.5;
bool first_row = true;

/// Compares the forces, then measures. Exits with 3 if the contestants disagree, because a wrong result is not timed.
void measure(const Row& row) {
  for (const auto& contestant : row.contestants) contestant.run();
  double difference = -1;
  if (row.contestants[0].name == "fused") {
    difference = largest_difference(row.contestants[0].forces(), row.contestants[1].forces());
    if (!(difference <= tolerance(row.scalar, row.membranes))) {
      std::fprintf(stderr, "%s, %s, %zu membrane(s), %s: the reference loop and the paper solver differ by %.3g N\n",
                   row.form.c_str(), row.scalar.c_str(), row.membranes, row.motion.c_str(), difference);
      std::exit(3);
    }
  }
  const Times times = time_against_each_other(row.contestants, ticks, seconds);
  std::printf("%s\n    {\"form\": \"%s\", \"scalar\": \"%s\", \"motion\": \"%s\", \"membranes\": %zu, ",
              first_row ? "" : ",", row.form.c_str(), row.scalar.c_str(), row.motion.c_str(), row.membranes);
  first_row = false;
  if (difference >= 0) std::printf("\"fused_minus_paper_N\": %.3g, ", difference);
  std::printf("\"repetitions\": %zu, \"contestants\": {", times.rounds[0].size());
  for (std::size_t i = 0; i < row.contestants.size(); ++i) {
    const Spread& t = times.spreads[i];
    std::printf(
        "%s       \"%s\": {\"median_ns\": %.4g, \"lower_quartile_ns\": %.4g, \"upper_quartile_ns\": %.4g,\n"
        "\"fastest_ns\": %.4g",
        i == 0 ? "" : ",", row.contestants[i].name.c_str(), t.median, t.lower_quartile, t.upper_quartile, t.fastest);
    if (difference >= 0 && i > 0) {
      const Spread over = ratio(times.rounds[i], times.rounds[0]);
      std::printf(", \"over_fused\": {\"median\": %.4g, \"lower_quartile\": %.4g, \"upper_quartile\": %.4g}",
                  over.median, over.lower_quartile, over.upper_quartile);
    }
    std::printf("}");
  }
  std::printf("}}");
  std::fflush(stdout);
  std::fprintf(stderr, ".");
}

/// Measures a membrane of tissue against one of K06 with the same solver.
void measure_tissue(const std::string& form, const std::string& motion, const std::string& solver,
                    const std::vector<Contestant>& contestants) {
  static bool first = true;
  const Times times = time_against_each_other(contestants, ticks, seconds);
  const Spread over = ratio(times.rounds[1], times.rounds[0]);
  std::printf(
      "%s\n    {\"form\": \"%s\", \"motion\": \"%s\", \"solver\": \"%s\", \"k06_ns\": %.4g, \"tissue_ns\": %.4g, "
      "\"over_k06\": "
      "{\"median\": %.4g, \"lower_quartile\": %.4g, \"upper_quartile\": %.4g}}",
      first ? "" : ",", form.c_str(), motion.c_str(), solver.c_str(), times.spreads[0].median, times.spreads[1].median,
      over.median, over.lower_quartile, over.upper_quartile);
  first = false;
  std::fprintf(stderr, ".");
}

/// Writes the depths of the one-membrane work, then the paper solver's forces, as doubles, for the NumPy loop.
void dump(const std::string& file, const Motion& motion, const std::vector<Contestant>& contestants) {
  contestants[1].run();
  std::vector<double> numbers;
  for (const Point& p : motion.tip) numbers.push_back(-p[1]);
  for (double f : contestants[1].forces()) numbers.push_back(f);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  if (!out) {
    std::fprintf(stderr, "cannot write %s\n", file.c_str());
    std::exit(2);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string dump_file;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "--seconds") seconds = std::atof(argv[i + 1]);
    if (std::string(argv[i]) == "--dump") dump_file = argv[i + 1];
  }
  std::printf("{\n  \"compiler\": \"%s\", \"flags\": \"%s\", \"ticks\": %zu, \"work\": [", BENCH_COMPILER, BENCH_FLAGS,
              ticks);

  std::vector<std::pair<punctura::Scene, Motion>> works;
  for (const std::size_t n : {1u, 2u, 8u, 64u}) {
    const auto scene = scene_of(n, punctura::Solver::exact);
    works.emplace_back(scene, strokes("encoder", scene, 5.5e-5));
    if (n == 1) works.emplace_back(scene, strokes("smooth", scene, 0));
  }
  for (std::size_t i = 0; i < works.size(); ++i) {
    const auto& [scene, motion] = works[i];
    const Shares s = shares(scene, motion);
    std::printf(
        "%s\n    {\"motion\": \"%s\", \"membranes\": %zu, \"outside\": %.4f, \"sticking\": %.4f, \"sliding_in\": %.4f, "
        "\"sliding_out\": %.4f}",
        i == 0 ? "" : ",", motion.name.c_str(), scene.membranes.size(), s.outside, s.sticking, s.sliding_in,
        s.sliding_out);
    check_exact(scene, motion);
  }
  if (!dump_file.empty()) dump(dump_file, works[0].second, contestants_1d<double>(works[0].first, works[0].second));

  std::printf("\n  ], \"rows\": [");
  for (const auto& [scene, motion] : works) {
    const std::size_t n = scene.membranes.size();
    measure({"1-D", "double", motion.name, n, contestants_1d<double>(scene, motion)});
    measure({"1-D", "float", motion.name, n, contestants_1d<float>(scene, motion)});
    measure({"3-D", "double", motion.name, n, contestants_3d<double>(scene, motion)});
    measure({"3-D", "float", motion.name, n, contestants_3d<float>(scene, motion)});
    measure({"servo step", "double", motion.name, n, contestants_servo(scene, motion)});
  }
  std::printf("\n  ], \"tissue\": [");
  const auto& scene = works[0].first;
  for (const auto& motion : {works[0].second, first_way()}) {
    for (const auto solver : {punctura::Solver::paper, punctura::Solver::exact}) {
      const std::string name = solver == punctura::Solver::paper ? "paper" : "exact";
      measure_tissue("1-D", motion.name, name, tissue_1d(scene, motion, solver));
      measure_tissue("3-D", motion.name, name, tissue_3d(scene, motion, solver));
    }
  }
  std::printf("\n  ]\n}\n");
  std::fprintf(stderr, "\n");
}
