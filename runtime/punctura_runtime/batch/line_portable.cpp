// run_line() with Portable.
#include "punctura_runtime/batch/line_kernel.hpp"
#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::batch {

const LineCode& line_code_portable() noexcept {
  static constexpr LineCode code{
      Portable::name, Portable::lanes, run_line<Portable, Paper>, run_line<Portable, Exact>, nullptr, nullptr,
      nullptr,        nullptr};
  return code;
}

}  // namespace punctura::batch
