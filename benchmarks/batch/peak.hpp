// What one core of the machine can do at most: vector operations, and bytes copied from memory to memory.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "../timing.hpp"
#include "operations.hpp"
#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::bench_batch {

inline constexpr int chains = 14;  // more than a core has under way; SSE2 and AVX2 have 16 registers

/// A product and a sum of `bytes / 8` doubles in each of 14 chains, `rounds` times. Each function is compiled for its
/// instruction set. Products and sums are not fused, as in the core.
#define PUNCTURA_PEAK(name, bytes, ...)                                                      \
  __attribute__((noinline __VA_ARGS__)) inline double name(long n) {                         \
    typedef double Vector __attribute__((vector_size(bytes)));                               \
    Vector x[chains], factor = Vector{} + 0.999, term = Vector{} + 1;                        \
    _Pragma("GCC unroll 14") for (int i = 0; i < chains; ++i) x[i] = Vector{} + i;           \
    for (long k = 0; k < n; ++k) {                                                           \
      _Pragma("GCC unroll 14") for (int i = 0; i < chains; ++i) x[i] = x[i] * factor + term; \
    }                                                                                        \
    double sum = 0;                                                                          \
    for (int i = 0; i < chains; ++i) sum += x[i][0];                                         \
    return sum;                                                                              \
  }
PUNCTURA_PEAK(peak_16, 16)
#if defined(__x86_64__)
PUNCTURA_PEAK(peak_32, 32, , target("avx2"))
PUNCTURA_PEAK(peak_64, 64, , target("avx512f"))
#endif
#undef PUNCTURA_PEAK

/// Most operations of a core on doubles with an instruction set, each nanosecond.
inline double operations_per_ns(const batch::LineCode& code) {
  constexpr long turns = 20'000;
  double (*run)(long) = peak_16;
#if defined(__x86_64__)
  if (std::string(code.name) == "avx2") run = peak_32;
  if (std::string(code.name) == "avx512") run = peak_64;
#endif
  double fastest = 1e300;
  for (int i = 0; i < 1000; ++i) {
    const double start = bench::computed_ns();
    volatile double kept = run(turns);
    (void)kept;
    fastest = std::min(fastest, bench::computed_ns() - start);
  }
  return static_cast<double>(2 * chains * turns * static_cast<long>(code.lanes)) / fastest;
}

/// Bytes that a core reads and writes each nanosecond where it copies what no cache holds.
inline double copied_bytes_per_ns() {
  const std::vector<double> from(32u << 20, 1.0);  // 256 MB
  std::vector<double> to(from.size());
  double fastest = 1e300;
  for (int i = 0; i < 7; ++i) {
    const double start = bench::computed_ns();
    std::copy(from.begin(), from.end(), to.begin());
    bench::keep_memory();
    fastest = std::min(fastest, bench::computed_ns() - start);
  }
  return 2.0 * sizeof(double) * static_cast<double>(from.size()) / fastest;
}

/// As JSON. line_bytes: that a trial and tick reads and writes.
inline void print_peak() {
  std::printf("\n  \"peak\": {\"line_bytes\": %zu, \"copied_bytes_per_ns\": %.4g, \"operations\": {",
              2 * sizeof(double), copied_bytes_per_ns());
  Work work(64, 1600);
  for (const Solver solver : {Solver::paper, Solver::exact}) {
    const Operations o = operations(work, solver);
    std::printf(
        "%s\"%s\": {\"all\": %.4g, \"multiply\": %.4g, \"add\": %.4g, \"divide\": %.4g, \"root\": %.4g, "
        "\"min_max\": %.4g, \"compare\": %.4g, \"select\": %.4g}",
        solver == Solver::paper ? "" : ", ", name_of(solver), o.all(), o.multiply, o.add, o.divide, o.root, o.min_max,
        o.compare, o.select);
  }
  std::printf("}, \"operations_per_ns\": {");
  const char* separator = "";
  for (const batch::LineCode* code : batch::line_codes()) {
    if (std::string(code->name) == "portable") continue;
    std::printf("%s\"%s\": %.4g", separator, code->name, operations_per_ns(*code));
    separator = ", ";
  }
  std::printf("}}");
}

}  // namespace punctura::bench_batch
