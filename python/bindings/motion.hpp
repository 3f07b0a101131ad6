// The motion of a simulated hand, and the ticks of an experiment with it.
#pragma once

#include <nanobind/stl/variant.h>

#include <cmath>
#include <variant>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "tick_columns.hpp"
#include "ticks.hpp"

namespace punctura::bindings {

using AnyMotion = std::variant<Strokes, RecordedMotion, Target>;
using LaidOutMotion = std::variant<StrokesMotion, RecordedMotion, Target>;

inline LaidOutMotion laid_out(const AnyMotion& motion, std::uint64_t seed) {
  if (const auto* strokes = std::get_if<Strokes>(&motion)) return StrokesMotion(*strokes, seed);
  if (const auto* recorded = std::get_if<RecordedMotion>(&motion)) return *recorded;
  return std::get<Target>(motion);
}

/// The number of ticks in a duration (s). Throws ValueError.
inline std::size_t ticks_in(double duration, double rate) {
  if (!(duration >= 0 && duration <= 1e9)) throw nb::value_error("duration must be from 0 to 1e9 s");
  return static_cast<std::size_t>(std::llround(duration * rate));
}

template <typename E>
TicksObject run_experiment(E& experiment, std::size_t n, const ProgressArgument& progress) {
  TickColumns columns({}, true);
  columns.reserve(n, experiment.servo().snapshot().membrane_count);
  make_ticks(
      n,
      [&](std::size_t) {
        const Snapshot& snapshot = experiment.step();
        columns.add(snapshot, experiment.extra());
      },
      progress);
  return columns.to_ticks();
}

}  // namespace punctura::bindings
