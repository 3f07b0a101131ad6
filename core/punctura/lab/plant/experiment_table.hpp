// The fields of a tick that only an experiment has.
#pragma once

#include <tuple>

#include "punctura/servo/tick_table.hpp"

namespace punctura {

/// The record of a simulated operator and device in a tick.
struct ExperimentExtra {
  std::array<double, 3> true_position;  ///< position of the plant's tip, m
  std::array<double, 3> desired;        ///< desired position of the hand, m
};

// clang-format off
/// The fields of a tick and the fields that only an experiment has.
inline constexpr auto experiment_table = std::tuple_cat(tick_table, std::tuple{
    tick_field("true_position", "true_{a}_m", "m", use_file,
        "Where the simulated tip is, without the encoders' steps. From an experiment only",
        &ExperimentExtra::true_position),
    tick_field("desired", "desired_{a}_m", "m", use_file,
        "Where the simulated hand wants to be. From an experiment only", &ExperimentExtra::desired),
});
// clang-format on

}  // namespace punctura
