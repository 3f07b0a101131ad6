// CMakeLists.txt sets the options of the instruction set for this file.
#include "punctura_runtime/batch/line_code.hpp"

namespace punctura::batch {

const LineCode& line_code_avx2() noexcept { return line_code_of<Avx2>; }

}  // namespace punctura::batch
