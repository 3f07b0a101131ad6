// What runs on every processor of the architecture: its vectors, and one double at a time. Macros choose the vectors,
// not CMake: a universal binary of macOS is compiled for two architectures at once.
#include "punctura_runtime/batch/line_code.hpp"

namespace punctura::batch {

#if defined(__x86_64__) || defined(_M_X64)
const LineCode* line_code_base() noexcept { return &line_code_of<Sse2>; }
#elif defined(__aarch64__)
const LineCode* line_code_base() noexcept { return &line_code_of<Neon>; }
#else
const LineCode* line_code_base() noexcept { return nullptr; }
#endif

const LineCode& line_code_portable() noexcept {
  static constexpr LineCode code{
      Portable::name, Portable::lanes, run_line<Portable, Paper>, run_line<Portable, Exact>, nullptr, nullptr,
      nullptr,        nullptr};
  return code;
}

}  // namespace punctura::batch
