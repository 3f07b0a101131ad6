// Batches of proxies on a line, and of trials with a simulated hand, against the core stepped tick by tick, in one
// program and over the same trials.
#include "growth.hpp"
#include "hands.hpp"
#include "line.hpp"
#include "peak.hpp"
#include "threads.hpp"

using namespace punctura;
using namespace punctura::bench_batch;

int main(int argc, char** argv) {
  double seconds = 2;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "--seconds") seconds = std::atof(argv[i + 1]);
    for (const Solver solver : {Solver::paper, Solver::exact})
      if (argv[i] == std::string("--") + name_of(solver))
        return run_hands(static_cast<std::size_t>(std::atol(argv[i + 1])), solver);
  }
  std::printf("{\n  \"compiler\": \"%s\", \"flags\": \"%s\", \"rows\": [", BENCH_COMPILER, BENCH_FLAGS);
  bool first = true;
  for (const auto& [trials, ticks] : {std::pair<std::size_t, std::size_t>{32, 4000}, {1024, 800}, {100'000, 64}}) {
    Work work(trials, ticks);
    for (const Solver solver : {Solver::paper, Solver::exact}) {
      std::printf("%s\n    {\"solver\": \"%s\", \"trials\": %zu, \"ticks\": %zu, \"contestants\": {", first ? "" : ",",
                  name_of(solver), trials, ticks);
      first = false;
      print(measure_line(work, solver, seconds));
      std::printf("}}");
      std::fflush(stdout);
      std::fprintf(stderr, ".");
    }
  }
  std::printf("\n  ], \"hands\": [");
  first = true;
  for (const Solver solver : {Solver::paper, Solver::exact})
    for (const bool tissue : {false, true}) {
      std::printf("%s\n    {\"solver\": \"%s\", \"wall\": \"%s\", \"contestants\": {", first ? "" : ",",
                  name_of(solver), tissue ? "tissue" : "K06");
      first = false;
      print(measure_hands(64, solver, tissue, seconds));
      std::printf("}}");
      std::fprintf(stderr, ".");
    }
  std::printf("\n  ], \"threads\": [");
  print_threads(seconds);
  std::printf("\n  ],");
  print_growth();
  std::fprintf(stderr, ".");
  std::printf(",");
  print_peak();
  std::fprintf(stderr, ".");
  std::printf(",\n  \"bytes_per_trial\": %zu\n}\n", sizeof(batch::LineBlock) / batch::block_lanes);
  std::fprintf(stderr, "\n");
}
