// The LineCode of an instruction set. It is compiled once for each, in the line_*.cpp.
#pragma once

#include "punctura_runtime/batch/fleet_kernel.hpp"
#include "punctura_runtime/batch/line_kernel.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "punctura_runtime/batch/scene_kernel.hpp"

namespace punctura::batch {

template <typename Isa>
inline constexpr LineCode line_code_of{Isa::name,
                                       Isa::lanes,
                                       run_line<Isa, Paper>,
                                       run_line<Isa, Exact>,
                                       run_scene<Isa, Paper>,
                                       run_scene<Isa, Exact>,
                                       make_fleet<Isa, Paper>,
                                       make_fleet<Isa, Exact>};

}  // namespace punctura::batch
