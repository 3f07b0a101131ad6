// The plain record of a tick: all that recorder, studio and tests ever see of one.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "punctura/device/sample.hpp"
#include "punctura/proxy/solver.hpp"
#include "punctura/safety/fault.hpp"
#include "punctura/safety/force_limits.hpp"

namespace punctura {

/// A scene may hold this many membranes, so that a snapshot has a fixed size.
inline constexpr std::size_t max_membranes = 64;

enum class ServoState : std::uint8_t {
  disarmed,  ///< the model runs, the device gets no force
  waiting,   ///< armed, but the tip is not in front of every membrane, or the dead-man button is not held
  active,    ///< forces go out, ramped in at first
  faulted,   ///< a fault is latched, the force is zero
};

/// What was asked of the step since the tick before, as bits: with them, and the samples, a recording can be run again.
enum Command : std::uint32_t { command_arm = 1, command_disarm = 2, command_reset = 4, command_scene = 8 };

struct MembraneRecord {
  double depth;                     ///< m, see Proxy3d::depth
  double axial_force;               ///< N, along b
  double lower, upper;              ///< N, the band
  std::array<double, 3> proxy;      ///< q(k), m
  std::array<double, 3> direction;  ///< b, while inside
  Phase phase;
};

struct Snapshot {
  std::uint64_t tick;
  DeviceSample sample;
  std::array<double, 3> tip;          ///< the conditioned position, m
  std::array<double, 3> model_force;  ///< the sum of all membranes, N
  std::array<double, 3> force;        ///< what goes to the device, N
  double ceiling;                     ///< the largest force permitted in this tick, by all limits, N
  LimitCounters limits;
  ServoState state;
  Fault fault;
  Limit limit;             ///< what makes `force` smaller than `model_force`
  std::uint32_t commands;  ///< bits of Command, obeyed in the order reset, arm, disarm
  std::uint32_t membrane_count;
  std::array<MembraneRecord, max_membranes> membranes;  ///< the first membrane_count are filled
};

static_assert(std::is_trivially_copyable_v<Snapshot>);

}  // namespace punctura
