// The faults: why a tick gave no force.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "punctura/model/field.hpp"
#include "punctura/model/law_flaw.hpp"

namespace punctura {

/// The reason for a fault. The first fault is latched: the force is zero until an explicit reset.
enum class Fault : std::uint8_t {
  none,
  non_finite_input,  ///< the device reported NaN, infinity, or a place that is_place() refuses
  bad_axis,          ///< the reported needle direction does not have length 1
  position_jump,     ///< the position moved faster than a hand can
  stale_sample,      ///< the device repeated the same sample for too long
  missed_deadline,   ///< the tick came too late, or the computer slept
  clock,             ///< the time went back
  non_finite_force,  ///< the model computed NaN or infinity, or its law has a flaw (find_flaw())
  device,            ///< the back-end reported a fault
  thumb,             ///< the device under the thumb has a fault or is silent
};
template <>
inline constexpr std::array<std::string_view, 10> words_of<Fault>{
    "none",  "non_finite_input", "bad_axis", "position_jump", "stale_sample", "missed_deadline",
    "clock", "non_finite_force", "device",   "thumb"};

/// The meaning of a fault, and what to do. The text is constant, because a tick formats nothing.
constexpr const char* describe(Fault fault) noexcept {
  switch (fault) {
    case Fault::none: return "no fault";
    case Fault::non_finite_input:
      return "the device reported a number that is not finite (position, direction, time or motor temperature) or a "
             "position beyond 1000 km: check its cable, its calibration and the unit, m, then reset";
    case Fault::bad_axis:
      return "the device reported a needle direction that is not of length 1: "
             "check its orientation sensors, or set direction = \"motion\" in the scene";
    case Fault::position_jump:
      return "the device's position moved faster than a hand can: "
             "check its cable, calibrate it, then reset with the tip outside tissue";
    case Fault::stale_sample: return "the device sent no new sample in time: check its connection, then reset";
    case Fault::missed_deadline:
      return "a tick came too late, or the computer slept: "
             "close programs that keep the processor busy, keep the computer awake, then reset";
    case Fault::clock: return "the clock went back between two ticks: the back-end must use one that never does";
    case Fault::non_finite_force: return flawed_in_run();
    case Fault::device: return "the device reported a fault of its own: check its cable and its power, then reset";
    case Fault::thumb:
      return "the device under the thumb has a fault of its own or sends nothing: check its connection, then reset";
  }
  return "unknown fault";
}

}  // namespace punctura
