// run_line(), run_scene() and make_fleet() with Avx512.
// CMakeLists.txt sets the options of the instruction set for this file.
#include "punctura_runtime/batch/fleet_kernel.hpp"
#include "punctura_runtime/batch/line_kernel.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/scene_kernel.hpp"

namespace punctura::batch {

const LineCode& line_code_avx512() noexcept {
  static constexpr LineCode code{"avx512",
                                 Avx512::lanes,
                                 run_line<Avx512, Paper>,
                                 run_line<Avx512, Exact>,
                                 run_scene<Avx512, Paper>,
                                 run_scene<Avx512, Exact>,
                                 make_fleet<Avx512, Paper>,
                                 make_fleet<Avx512, Exact>};
  return code;
}

}  // namespace punctura::batch
