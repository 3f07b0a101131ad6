// What one core of the machine can do at most: vector operations, and bytes copied from memory to memory.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "../timing.hpp"
#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::bench_batch {

inline constexpr int chains = 12;  // independent of each other, so that no operation waits for another

/// A product and a sum of `bytes / 8` doubles in each of 12 chains, `rounds` times. Each function is compiled for its
/// instruction set. Products and sums are not fused, as in the core.
#define PUNCTURA_PEAK(name, bytes, ...)                                                      \
  __attribute__((noinline __VA_ARGS__)) inline double name(long n) {                         \
    typedef double Vector __attribute__((vector_size(bytes)));                               \
    Vector x[chains], factor = Vector{} + 0.999, term = Vector{} + 1;                        \
    _Pragma("GCC unroll 12") for (int i = 0; i < chains; ++i) x[i] = Vector{} + i;           \
    for (long k = 0; k < n; ++k) {                                                           \
      _Pragma("GCC unroll 12") for (int i = 0; i < chains; ++i) x[i] = x[i] * factor + term; \
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
inline double operations_per_ns(const std::string& code) {
  constexpr long rounds = 200'000;
  double (*run)(long) = peak_16;
  int lanes = 2;
#if defined(__x86_64__)
  if (code == "avx2") run = peak_32, lanes = 4;
  if (code == "avx512") run = peak_64, lanes = 8;
#endif
  double fastest = 1e300;
  for (int i = 0; i < 15; ++i) {
    const double start = bench::computed_ns();
    volatile double kept = run(rounds);
    (void)kept;
    fastest = std::min(fastest, bench::computed_ns() - start);
  }
  return 2.0 * chains * lanes * rounds / fastest;
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

/// As JSON. operations: of a trial and tick with K06 (33), one membrane (docs/performance.md); bytes: read and written.
inline void print_peak() {
  std::printf("\n  \"peak\": {\"paper_operations\": 27, \"line_bytes\": 16, \"copied_bytes_per_ns\": %.4g",
              copied_bytes_per_ns());
  std::printf(", \"operations_per_ns\": {");
  const char* separator = "";
  for (const batch::LineCode* code : batch::line_codes()) {
    if (std::string(code->name) == "portable") continue;
    std::printf("%s\"%s\": %.4g", separator, code->name, operations_per_ns(code->name));
    separator = ", ";
  }
  std::printf("}}");
}

}  // namespace punctura::bench_batch
