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

/// One field of a Record: a Snapshot, a MembraneRecord, or a record beside the snapshot. `get` returns a reference to
/// it, so that a replay can set it.
template <typename Record_, typename Get>
struct TickField {
  using Record = Record_;
  using Value = std::remove_cvref_t<std::invoke_result_t<const Get&, const Record&>>;
  static constexpr bool per_membrane = std::is_same_v<Record, MembraneRecord>;
  const char* name;
  /// Name of the column in a file. {a} is x, y or z. {i} is the number of the membrane.
  const char* column;
  const char* unit;  ///< empty for numbers without a unit
  unsigned use;
  const char* help;
  Get get;
};

/// The field that is this member of a record, or a member of this member.
template <typename Record, typename Member, typename... Inner>
constexpr auto tick_field(const char* name, const char* column, const char* unit, unsigned use, const char* help,
                          Member Record::* member, Inner... inner) {
  auto get = [=](auto& record) -> auto& { return ((record.*member).*....*inner); };
  return TickField<Record, decltype(get)>{name, column, unit, use, help, get};
}

// clang-format off
/// The fields in the order of the columns in a file. The fields that a person looks for first come first.
inline constexpr std::tuple tick_table{
    tick_field("tick", "tick", "", use_file, "Number of the tick, from 0", &Snapshot::tick),
    tick_field("time", "time_s", "s", use_input | use_page,
        "When the tick began, on a clock that never goes back", &Snapshot::sample, &DeviceSample::time),
    tick_field("position", "{a}_m", "m", use_input | use_page,
        "The needle's tip as the device reported it", &Snapshot::sample, &DeviceSample::position),
    tick_field("axis", "axis_{a}", "", use_input | use_page,
        "Unit direction in which the needle points", &Snapshot::sample, &DeviceSample::axis),
    tick_field("force", "f{a}_N", "N", use_page,
        "The felt force, which goes to the device: after force scale and all limits", &Snapshot::force),
    tick_field("depth", "depth_{i}_m", "m", use_page,
        "Depth of the band. Inside: along the needle's direction b. Outside: along the normal. 0 is the surface",
        &MembraneRecord::depth),
    tick_field("axial_force", "force_{i}_N", "N", use_page,
        "The membrane's force along the needle's direction b", &MembraneRecord::axial_force),
    tick_field("lower", "lower_{i}_N", "N", use_page,
        "Lower edge of the band of friction, Phi_I", &MembraneRecord::lower),
    tick_field("upper", "upper_{i}_N", "N", use_page,
        "Upper edge of the band of friction, Phi_O", &MembraneRecord::upper),
    tick_field("phase", "phase_{i}", "", use_page, "What the needle does in the membrane", &MembraneRecord::phase),
    tick_field("proxy", "proxy_{i}_{a}_m", "m", use_page, "The proxy q", &MembraneRecord::proxy),
    tick_field("direction", "direction_{i}_{a}", "", use_page,
        "The needle's direction b, held from entry on while inside", &MembraneRecord::direction),
    tick_field("model_force", "model_f{a}_N", "N", use_page,
        "The model's force, all membranes together, before force scale and limits", &Snapshot::model_force),
    tick_field("force_scale", "force_scale", "", use_page,
        "How much of model_force this device gives, before the limits: greater than 0, at most 1",
        &Snapshot::force_scale),
    tick_field("tip", "tip_{a}_m", "m", use_page, "The conditioned position, which the model gets", &Snapshot::tip),
    tick_field("thumb", "thumb_m", "m", use_input | use_page,
        "Depth of the thumb on the syringe's plunger, from where the plunger starts",
        &Snapshot::sample, &DeviceSample::thumb),
    tick_field("plunger", "plunger_m", "m", use_page,
        "Depth of the syringe's plunger; NaN if the scene has no syringe", &Snapshot::syringe, &SyringeRecord::plunger),
    tick_field("thumb_force", "thumb_force_N", "N", use_page,
        "The plunger's force on the thumb, negative while the thumb pushes; NaN without a syringe",
        &Snapshot::syringe, &SyringeRecord::force),
    tick_field("thumb_felt", "thumb_felt_N", "N", use_input | use_page,
        "Felt force of the thumb: what a second device gave last, after force scale and its limits; 0 without one",
        &Snapshot::sample, &DeviceSample::thumb_felt),
    tick_field("pressure", "pressure_Pa", "Pa", use_page,
        "Pressure in the syringe above that of the atmosphere; NaN without a syringe",
        &Snapshot::syringe, &SyringeRecord::pressure),
    tick_field("injected", "injected_m3", "m^3", use_page,
        "Volume that left the syringe through the needle so far; NaN without a syringe",
        &Snapshot::syringe, &SyringeRecord::left),
    tick_field("state", "state", "", use_page, "What the servo step does with forces", &Snapshot::state),
    tick_field("fault", "fault", "", use_page, "The latched fault", &Snapshot::fault),
    tick_field("limit", "limit", "", use_page,
        "The limit that makes force smaller than force_scale times model_force", &Snapshot::limit),
    tick_field("commands", "commands", "", use_input,
        "What was asked since the tick before, as bits: 1 arm, 2 disarm, 4 reset, 8 a new scene", &Snapshot::commands),
    tick_field("sequence", "sequence", "", use_input,
        "The device's own count of readings", &Snapshot::sample, &DeviceSample::sequence),
    tick_field("buttons", "buttons", "", use_input,
        "Buttons that are held, one bit each", &Snapshot::sample, &DeviceSample::buttons),
    tick_field("healthy", "healthy", "", use_input,
        "False where the device's back-end reports a fault of its own", &Snapshot::sample, &DeviceSample::healthy),
    tick_field("motor_temperature", "motor_temperature", "", use_input,
        "Hottest motor: 0 is cold or not reported, 1 is the maker's danger limit",
        &Snapshot::sample, &DeviceSample::motor_temperature),
    tick_field("ceiling", "ceiling_N", "N", use_page,
        "The largest force that all limits permit in this tick", &Snapshot::ceiling),
    tick_field("peak_limited", "peak_limited", "", use_file,
        "Ticks so far in which the peak limit acted", &Snapshot::limits, &LimitCounters::peak),
    tick_field("continuous_limited", "continuous_limited", "", use_file,
        "Ticks so far in which the limit on continuous force acted", &Snapshot::limits, &LimitCounters::continuous),
    tick_field("temperature_limited", "temperature_limited", "", use_file,
        "Ticks so far in which warm motors lowered the ceiling", &Snapshot::limits, &LimitCounters::temperature),
    tick_field("ramp_limited", "ramp_limited", "", use_file,
        "Ticks so far in which the force still grew after arming", &Snapshot::limits, &LimitCounters::ramp),
};
// clang-format on

/// Calls visit(field, index) for each field of a table, in its order.
template <typename Table, typename Visit>
constexpr void for_each_field(const Table& table, Visit&& visit) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visit(std::get<i>(table), std::integral_constant<std::size_t, i>{}), ...);
  }(std::make_index_sequence<std::tuple_size_v<Table>>{});
}

}  // namespace punctura
