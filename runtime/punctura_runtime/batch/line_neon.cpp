// run_line(), run_scene() and make_fleet() with Neon.
#include "punctura_runtime/batch/fleet_kernel.hpp"
#include "punctura_runtime/batch/line_kernel.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/scene_kernel.hpp"

namespace punctura::batch {

const LineCode& line_code_neon() noexcept {
  static constexpr LineCode code{"neon",
                                 Neon::lanes,
                                 run_line<Neon, Paper>,
                                 run_line<Neon, Exact>,
                                 run_scene<Neon, Paper>,
                                 run_scene<Neon, Exact>,
                                 make_fleet<Neon, Paper>,
                                 make_fleet<Neon, Exact>};
  return code;
}

}  // namespace punctura::batch
