// The table of the fields of a tick. Recordings, exports, the page, Python and docs/tick.md are generated from it.
// To add a field, add one entry here.
#pragma once

#include <tuple>
#include <type_traits>

#include "punctura/servo/snapshot.hpp"

namespace punctura {

/// The readers of a field besides recordings and exports, as bits.
enum TickUse : unsigned {
  use_file = 0,
  use_input = 1,  ///< an input of the tick: a replay needs it
  use_page = 2,   ///< sent to the studio's page
};

/// The record that contains a field.
enum class TickPart {
  snapshot,
  membrane,  ///< the record of a membrane in the snapshot
  extra,     ///< a record beside the snapshot: ExperimentExtra
};

/// One field. `get` reads it from its part. It returns a reference to a stored field, so that a replay can set it. It
/// returns a value for a derived field.
template <TickPart part_, typename Get>
struct TickField {
  static constexpr TickPart part = part_;
  static constexpr bool per_membrane = part == TickPart::membrane;
  const char* name;
  /// Name of the column in a file. {a} is x, y or z. {i} is the number of the membrane.
  const char* column;
  const char* unit;  ///< empty for numbers without a unit
  const char* says;
  unsigned use;
  Get get;

  template <typename Record>
  using Value = std::remove_cvref_t<std::invoke_result_t<const Get&, const Record&>>;
  /// Whether a replay can set the field in a Record.
  template <typename Record>
  static constexpr bool stored = std::is_lvalue_reference_v<std::invoke_result_t<const Get&, Record&>>;
};

namespace detail {
template <TickPart part, typename Get>
constexpr auto tick_field(const char* name, const char* column, const char* unit, unsigned use, Get get,
                          const char* says) {
  return TickField<part, Get>{name, column, unit, says, use, get};
}
}  // namespace detail

// clang-format off
/// The fields in the order of the columns in a file. The fields that a person looks for first come first.
inline constexpr std::tuple tick_table{
    detail::tick_field<TickPart::snapshot>("tick", "tick", "", use_file,
        [](auto& s) -> auto& { return s.tick; },
        "Number of the tick, from 0"),
    detail::tick_field<TickPart::snapshot>("time", "time_s", "s", use_input | use_page,
        [](auto& s) -> auto& { return s.sample.time; },
        "When the tick began, on a clock that never goes back"),
    detail::tick_field<TickPart::snapshot>("position", "{a}_m", "m", use_input | use_page,
        [](auto& s) -> auto& { return s.sample.position; },
        "The needle's tip as the device reported it"),
    detail::tick_field<TickPart::snapshot>("axis", "axis_{a}", "", use_input | use_page,
        [](auto& s) -> auto& { return s.sample.axis; },
        "Unit direction in which the needle points"),
    detail::tick_field<TickPart::snapshot>("force", "f{a}_N", "N", use_page,
        [](auto& s) -> auto& { return s.force; },
        "The felt force, which goes to the device: after force scale and all limits"),
    detail::tick_field<TickPart::membrane>("depth", "depth_{i}_m", "m", use_page,
        [](auto& m) -> auto& { return m.depth; },
        "Depth of the band. Inside: along the needle's direction b. Outside: along the normal. 0 is the surface"),
    detail::tick_field<TickPart::membrane>("axial_force", "force_{i}_N", "N", use_page,
        [](auto& m) -> auto& { return m.axial_force; },
        "The membrane's force along the needle's direction b"),
    detail::tick_field<TickPart::membrane>("lower", "lower_{i}_N", "N", use_page,
        [](auto& m) -> auto& { return m.lower; },
        "Lower edge of the band of friction, Phi_I"),
    detail::tick_field<TickPart::membrane>("upper", "upper_{i}_N", "N", use_page,
        [](auto& m) -> auto& { return m.upper; },
        "Upper edge of the band of friction, Phi_O"),
    detail::tick_field<TickPart::membrane>("phase", "phase_{i}", "", use_page,
        [](auto& m) -> auto& { return m.phase; },
        "What the needle does in the membrane"),
    detail::tick_field<TickPart::membrane>("proxy", "proxy_{i}_{a}_m", "m", use_page,
        [](auto& m) -> auto& { return m.proxy; },
        "The proxy q"),
    detail::tick_field<TickPart::membrane>("direction", "direction_{i}_{a}", "", use_page,
        [](auto& m) -> auto& { return m.direction; },
        "The needle's direction b, held from entry on while inside"),
    detail::tick_field<TickPart::snapshot>("model_force", "model_f{a}_N", "N", use_page,
        [](auto& s) -> auto& { return s.model_force; },
        "The model's force, all membranes together, before force scale and limits"),
    detail::tick_field<TickPart::snapshot>("force_scale", "force_scale", "", use_page,
        [](auto& s) -> auto& { return s.force_scale; },
        "How much of model_force this device gives, before the limits: greater than 0, at most 1"),
    detail::tick_field<TickPart::snapshot>("tip", "tip_{a}_m", "m", use_page,
        [](auto& s) -> auto& { return s.tip; },
        "The conditioned position, which the model gets"),
    detail::tick_field<TickPart::snapshot>("thumb", "thumb_m", "m", use_input | use_page,
        [](auto& s) -> auto& { return s.sample.thumb; },
        "Depth of the thumb on the syringe's plunger, from where the plunger starts"),
    detail::tick_field<TickPart::snapshot>("plunger", "plunger_m", "m", use_page,
        [](auto& s) -> auto& { return s.syringe.plunger; },
        "Depth of the syringe's plunger; NaN if the scene has no syringe"),
    detail::tick_field<TickPart::snapshot>("thumb_force", "thumb_force_N", "N", use_page,
        [](auto& s) -> auto& { return s.syringe.force; },
        "The plunger's force on the thumb, negative while the thumb pushes; NaN without a syringe"),
    detail::tick_field<TickPart::snapshot>("thumb_felt", "thumb_felt_N", "N", use_input | use_page,
        [](auto& s) -> auto& { return s.sample.thumb_felt; },
        "Felt force of the thumb: what a second device gave last, after force scale and its limits; 0 without one"),
    detail::tick_field<TickPart::snapshot>("pressure", "pressure_Pa", "Pa", use_page,
        [](auto& s) -> auto& { return s.syringe.pressure; },
        "Pressure in the syringe above that of the atmosphere; NaN without a syringe"),
    detail::tick_field<TickPart::snapshot>("injected", "injected_m3", "m^3", use_page,
        [](auto& s) -> auto& { return s.syringe.left; },
        "Volume that left the syringe through the needle so far; NaN without a syringe"),
    detail::tick_field<TickPart::snapshot>("state", "state", "", use_page,
        [](auto& s) -> auto& { return s.state; },
        "What the servo step does with forces"),
    detail::tick_field<TickPart::snapshot>("fault", "fault", "", use_page,
        [](auto& s) -> auto& { return s.fault; },
        "The latched fault"),
    detail::tick_field<TickPart::snapshot>("limit", "limit", "", use_page,
        [](auto& s) -> auto& { return s.limit; },
        "The limit that makes force smaller than force_scale times model_force"),
    detail::tick_field<TickPart::snapshot>("commands", "commands", "", use_input,
        [](auto& s) -> auto& { return s.commands; },
        "What was asked since the tick before, as bits: 1 arm, 2 disarm, 4 reset, 8 a new scene"),
    detail::tick_field<TickPart::snapshot>("sequence", "sequence", "", use_input,
        [](auto& s) -> auto& { return s.sample.sequence; },
        "The device's own count of readings"),
    detail::tick_field<TickPart::snapshot>("buttons", "buttons", "", use_input,
        [](auto& s) -> auto& { return s.sample.buttons; },
        "Buttons that are held, one bit each"),
    detail::tick_field<TickPart::snapshot>("healthy", "healthy", "", use_input,
        [](auto& s) -> auto& { return s.sample.healthy; },
        "False where the device's back-end reports a fault of its own"),
    detail::tick_field<TickPart::snapshot>("motor_temperature", "motor_temperature", "", use_input,
        [](auto& s) -> auto& { return s.sample.motor_temperature; },
        "Hottest motor: 0 is cold or not reported, 1 is the maker's danger limit"),
    detail::tick_field<TickPart::snapshot>("ceiling", "ceiling_N", "N", use_page,
        [](auto& s) -> auto& { return s.ceiling; },
        "The largest force that all limits permit in this tick"),
    detail::tick_field<TickPart::snapshot>("peak_limited", "peak_limited", "", use_file,
        [](auto& s) -> auto& { return s.limits.peak; },
        "Ticks so far in which the peak limit acted"),
    detail::tick_field<TickPart::snapshot>("continuous_limited", "continuous_limited", "", use_file,
        [](auto& s) -> auto& { return s.limits.continuous; },
        "Ticks so far in which the limit on continuous force acted"),
    detail::tick_field<TickPart::snapshot>("temperature_limited", "temperature_limited", "", use_file,
        [](auto& s) -> auto& { return s.limits.temperature; },
        "Ticks so far in which warm motors lowered the ceiling"),
    detail::tick_field<TickPart::snapshot>("ramp_limited", "ramp_limited", "", use_file,
        [](auto& s) -> auto& { return s.limits.ramp; },
        "Ticks so far in which the force still grew after arming"),
};
// clang-format on

/// The page gets numbers as float32, so a wide integer would lose digits there.
template <typename Value>
inline constexpr bool fits_the_page =
    std::is_floating_point_v<Value> || std::is_enum_v<Value> || std::is_same_v<Value, std::array<double, 3>>;

/// Calls visit(field, index) for each field of a table, in its order.
template <typename Table, typename Visit>
constexpr void for_each_field(const Table& table, Visit&& visit) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visit(std::get<i>(table), std::integral_constant<std::size_t, i>{}), ...);
  }(std::make_index_sequence<std::tuple_size_v<Table>>{});
}

}  // namespace punctura
