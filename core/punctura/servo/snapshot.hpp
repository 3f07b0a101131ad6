// The snapshot, the complete record of a tick. Recorder, studio and tests read nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "punctura/device/sample.hpp"
#include "punctura/model/field.hpp"
#include "punctura/proxy/in_space.hpp"
#include "punctura/proxy/on_a_line.hpp"
#include "punctura/proxy/solver.hpp"
#include "punctura/safety/fault.hpp"
#include "punctura/safety/force_limits.hpp"

namespace punctura {

/// The largest number of membranes in a scene. It gives a snapshot a fixed size.
inline constexpr std::size_t max_membranes = 64;

enum class ServoState : std::uint8_t {
  disarmed,  ///< the model runs, and the device gets no force
  waiting,   ///< armed, but the tip is not in front of every membrane, or no dead-man button is held
  active,    ///< the device gets force, with a ramp at the start
  faulted,   ///< a fault is latched, and the force is zero
};
template <>
inline constexpr std::array<std::string_view, 4> words_of<ServoState>{"disarmed", "waiting", "active", "faulted"};

/// The commands to the step since the previous tick, as bits. A replay needs them and the samples.
enum Command : std::uint32_t { command_arm = 1, command_disarm = 2, command_reset = 4, command_scene = 8 };

/// What a tick did in one membrane.
struct MembraneRecord {
  double depth;                     ///< m, see SpaceTick::depth
  double axial_force;               ///< N, along b
  double lower, upper;              ///< the band, N
  std::array<double, 3> proxy;      ///< q(k), m
  std::array<double, 3> direction;  ///< b, valid while inside
  Phase phase;
};

/// The record of the syringe in a tick. All NaN if the scene has none.
struct SyringeRecord {
  double plunger;   ///< q(k), m, inwards from where it starts
  double force;     ///< N, on the thumb, negative while it pushes
  double pressure;  ///< in the syringe, above that of the atmosphere, Pa
  double left;      ///< volume that left through the needle so far, m^3
};
inline constexpr SyringeRecord no_syringe{not_given, not_given, not_given, not_given};

/// All of a tick: the reading, the force before and after the limits, and each membrane.
struct Snapshot {
  std::uint64_t tick;
  DeviceSample sample;
  std::array<double, 3> tip;          ///< the conditioned position, m
  std::array<double, 3> model_force;  ///< the force of the model: the sum of all membranes, N
  std::array<double, 3> force;        ///< the force for the device, N
  double force_scale;                 ///< how much of the model's force the device gives, before all limits
  double ceiling;                     ///< the largest force that all limits permit in this tick, N
  LimitCounters limits;
  SyringeRecord syringe;
  ServoState state;
  Fault fault;
  Limit limit;             ///< the limit that makes `force` smaller than `force_scale` times `model_force`
  std::uint32_t commands;  ///< bits of Command, executed in the order reset, arm, disarm
  std::uint32_t membrane_count;
  std::array<MembraneRecord, max_membranes> membranes;  ///< the first membrane_count are valid
};

static_assert(std::is_trivially_copyable_v<Snapshot>);

/// The record of a tick in space.
template <typename Scalar>
constexpr MembraneRecord record_of(const SpaceTick<Scalar>& t) noexcept {
  return {t.depth, t.axial_force, t.band.lower, t.band.upper, to_array(t.proxy), to_array(t.direction), t.phase};
}

/// The record of a tick on a line. The needle's direction is the x axis.
template <typename Scalar>
constexpr MembraneRecord record_of(const LineTick<Scalar>& t) noexcept {
  return {t.depth, t.force, t.band.lower, t.band.upper, {t.proxy, 0, 0}, {1, 0, 0}, t.phase};
}

}  // namespace punctura
