// run_line(), run_scene() and make_fleet() with Avx2.
// CMakeLists.txt sets the options of the instruction set for this file.
#include "punctura_runtime/batch/fleet_kernel.hpp"
#include "punctura_runtime/batch/line_kernel.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/scene_kernel.hpp"

namespace punctura::batch {

const LineCode& line_code_avx2() noexcept {
  static constexpr LineCode code{"avx2",
                                 Avx2::lanes,
                                 run_line<Avx2, Paper>,
                                 run_line<Avx2, Exact>,
                                 run_scene<Avx2, Paper>,
                                 run_scene<Avx2, Exact>,
                                 make_fleet<Avx2, Paper>,
                                 make_fleet<Avx2, Exact>};
  return code;
}

}  // namespace punctura::batch
