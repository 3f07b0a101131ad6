// run_line(), run_scene() and make_fleet() for each instruction set,
// and the choice of the best one that this processor has.
#pragma once

#include <string>
#include <vector>

#include "punctura/proxy/solver.hpp"
#include "punctura_runtime/batch/line_block.hpp"
#include "punctura_runtime/batch/scene_block.hpp"

namespace punctura::batch {

/// The code of one instruction set.
struct LineCode {
  const char* name;   ///< "avx512", "avx2", "sse2", "neon" or "portable"
  std::size_t lanes;  ///< doubles in a vector
  RunLine paper, exact;
  // Null in "portable": one lane at a time is as fast.
  RunScene scene_paper, scene_exact;
  MakeFleet fleet_paper, fleet_exact;

  RunLine of(Solver solver) const noexcept { return solver == Solver::paper ? paper : exact; }
  RunScene scene_of(Solver solver) const noexcept { return solver == Solver::paper ? scene_paper : scene_exact; }
  MakeFleet fleet_of(Solver solver) const noexcept { return solver == Solver::paper ? fleet_paper : fleet_exact; }
};

const LineCode& line_code_portable() noexcept;
/// "sse2" or "neon"; null on a processor without vectors that this file knows.
const LineCode* line_code_base() noexcept;
// Only with PUNCTURA_BATCH_AVX2, or PUNCTURA_BATCH_AVX512.
const LineCode& line_code_avx2() noexcept;
const LineCode& line_code_avx512() noexcept;

/// The instruction sets of this build that the processor has, the fastest first.
const std::vector<const LineCode*>& line_codes();

/// The one with this name. An empty name gives the fastest. Null if the processor or the build does not have it.
const LineCode* line_code(const std::string& name);

}  // namespace punctura::batch
