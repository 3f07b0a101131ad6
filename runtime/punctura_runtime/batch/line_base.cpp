// The vectors that every processor of the architecture has. The macros choose them, not CMake: a universal binary of
// macOS is compiled for two architectures at once.
#include "punctura_runtime/batch/line_code.hpp"

namespace punctura::batch {

#if defined(__x86_64__) || defined(_M_X64)
const LineCode* line_code_base() noexcept { return &line_code_of<Sse2>; }
#elif defined(__aarch64__)
const LineCode* line_code_base() noexcept { return &line_code_of<Neon>; }
#else
const LineCode* line_code_base() noexcept { return nullptr; }
#endif

}  // namespace punctura::batch
