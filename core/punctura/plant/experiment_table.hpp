// What an experiment knows of a tick besides its snapshot.
#pragma once

#include <tuple>

#include "punctura/servo/tick_table.hpp"

namespace punctura {

/// Of a simulated operator at a simulated device.
struct ExperimentExtra {
  std::array<double, 3> true_position;  ///< where the plant's tip is, m
  std::array<double, 3> desired;        ///< where the hand wants to be, m
};

// clang-format off
/// The fields of a tick, and those that only an experiment has.
inline constexpr auto experiment_table = std::tuple_cat(tick_table, std::tuple{
    detail::tick_field<TickPart::extra>("true_position", "true_{a}_m", "m", use_file,
        [](auto& e) -> auto& { return e.true_position; },
        "Where the simulated tip is, without the encoders' steps. From an experiment only"),
    detail::tick_field<TickPart::extra>("desired", "desired_{a}_m", "m", use_file,
        [](auto& e) -> auto& { return e.desired; },
        "Where the simulated hand wants to be. From an experiment only"),
});
// clang-format on

}  // namespace punctura
