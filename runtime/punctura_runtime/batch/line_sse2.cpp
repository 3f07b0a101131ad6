// run_line(), run_scene() and make_fleet() with Sse2.
#include "punctura_runtime/batch/fleet_kernel.hpp"
#include "punctura_runtime/batch/line_kernel.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/scene_kernel.hpp"

namespace punctura::batch {

const LineCode& line_code_sse2() noexcept {
  static constexpr LineCode code{"sse2",
                                 Sse2::lanes,
                                 run_line<Sse2, Paper>,
                                 run_line<Sse2, Exact>,
                                 run_scene<Sse2, Paper>,
                                 run_scene<Sse2, Exact>,
                                 make_fleet<Sse2, Paper>,
                                 make_fleet<Sse2, Exact>};
  return code;
}

}  // namespace punctura::batch
