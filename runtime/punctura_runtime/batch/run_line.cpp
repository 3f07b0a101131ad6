#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::batch {

const std::vector<const LineCode*>& line_codes() {
  static const std::vector<const LineCode*> codes = [] {
    std::vector<const LineCode*> found;
#if defined(PUNCTURA_BATCH_AVX512)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) found.push_back(&line_code_avx512());
#endif
#if defined(PUNCTURA_BATCH_AVX2)
    if (__builtin_cpu_supports("avx2")) found.push_back(&line_code_avx2());
#endif
    if (const LineCode* base = line_code_base()) found.push_back(base);
    found.push_back(&line_code_portable());
    return found;
  }();
  return codes;
}

const LineCode* line_code(const std::string& name) {
  for (const LineCode* code : line_codes())
    if (name.empty() || name == code->name) return code;
  return nullptr;
}

}  // namespace punctura::batch
