// The tables of a scene's fields. Those of needle, membrane, tissue and syringe stand beside these structs.
#pragma once

#include <array>
#include <string>
#include <tuple>

#include "punctura/model/validity.hpp"
#include "punctura/scene/scene.hpp"

namespace punctura {

// clang-format off
inline constexpr FieldOf<Coupling> coupling_fields[] = {
    {{"stiffness", "K", "N/m",
      {0, no_bound, true, true, ": the proxy hangs on this spring, K06 (21)"},
      "Spring of the virtual coupling.", in_unit("N_per_mm"), {5, 1e5}}, &Coupling::stiffness},
    {{"damping", "B", "N s/m", {0, no_bound, false, true, ", K06 (21)"},
      "Damper of the virtual coupling.", in_unit("Ns_per_mm")}, &Coupling::damping},
};

inline constexpr FieldOf<MaxwellBranch> branch_fields[] = {
    {{"stiffness", "K_m", "N/m", {0, no_bound, false, true, "", "no branch"},
      "Springs of the branches whose force decays while the needle rests, at most two. Empty is K06's coupling.",
      in_unit("N_per_mm"), {}, "Relaxation, stiffness"}, &MaxwellBranch::stiffness},
    {{"time_constant", "tau", "s",
      {1e-4, 1e4, false, false, ": from less than a tick to longer than a run"},
      "Time constant of each branch.", in_unit("s"), {}, "Relaxation, time"}, &MaxwellBranch::time_constant},
};
template <>
inline constexpr const auto& columns_of<MaxwellBranch> = branch_fields;

inline constexpr std::tuple servo_rows{
    FieldOf<ServoSettings>{{"rate", "1/T", "Hz",
      {100, 1e5, false, false, ": below, forces step; above, no device follows"},
      "Ticks per second.", in_unit("hz")}, &ServoSettings::rate},
    FieldOf<ServoSettings>{{"low_pass", "", "Hz", {0, no_bound, false, true, "", "off"},
      "Cut-off of the conditioning low_pass; 0 is off.", in_unit("hz"), {}, "Low-pass"}, &ServoSettings::low_pass},
    FieldOf<ServoSettings, Solver>{{"solver", "", "", {},
      "exact solves K06 (21)-(23); paper takes one step towards it, K06 (33)."}, &ServoSettings::solver},
    FieldOf<ServoSettings, Conditioning>{{"conditioning", "", "", {},
      "Filter of the positions: low_pass is K06's first-order filter; line_fit is for real devices, whose encoder "
      "steps would shake the force."}, &ServoSettings::conditioning},
    FieldOf<ServoSettings>{{"encoder_step", "", "m",
      {0, 1e-3, false, false, ": no device counts coarser", "an ideal sensor"},
      "Jump of the tip's measured position per encoder count, for line_fit; 0 is an ideal sensor.", in_unit("mm")},
      &ServoSettings::encoder_step},
    FieldOf<ServoSettings>{{"sub_steps", "", "-", {1, 16, false, false, ", a whole number"},
      "Steps of the model in each tick. More steps find the time of a pop better and cost more.", {}, {},
      "Sub-steps"}, &ServoSettings::sub_steps},
};
inline constexpr auto servo_fields = numbers_of(servo_rows);

inline constexpr FieldOf<DisplaySettings> display_fields[] = {
    {{"force_scale", "", "-",
      {0, 1, true, false, ": a device must not give more than the model's force"},
      "How much of the model's force the device gives. automatic: as much as it can give for any time, and at most "
      "all."}, &DisplaySettings::force_scale},
};

inline constexpr FieldOf<Coupling> thumb_fields[] = {
    {{"thumb_stiffness", "K", "N/m", {0, no_bound, true, true, ": the plunger hangs on it"},
      "Spring of the virtual coupling between thumb and plunger.", in_unit("N_per_mm"), {5, 1e5}},
      &Coupling::stiffness},
    {{"thumb_damping", "B", "N s/m", at_least_0,
      "Damper of this coupling.", in_unit("Ns_per_mm")}, &Coupling::damping},
};

/// What liquid from the needle meets: in a membrane, and in the space behind it.
inline constexpr FieldOf<Outlet> outflow_fields[] = {
    {{"outflow_resistance", "R_t", "Pa s/m^3", resistance_range,
      "Flow resistance for liquid from the needle, in the membrane.", in_unit("kPa_s_per_mL")}, &Outlet::resistance},
    {{"outflow_pressure", "P_t", "Pa", pressure_range,
      "Pressure in the membrane.", in_unit("kPa")}, &Outlet::pressure},
};
inline constexpr FieldOf<Outlet> outflow_behind_fields[] = {
    {{"behind_resistance", "R_t", "Pa s/m^3", resistance_range,
      "Flow resistance for liquid from the needle, in the space behind.", in_unit("kPa_s_per_mL"), {},
      "Resistance behind"}, &Outlet::resistance},
    {{"behind_pressure", "P_t", "Pa", pressure_range,
      "Pressure in the space behind.", in_unit("kPa"), {}, "Pressure behind"}, &Outlet::pressure},
};

/// What a membrane of a scene has beside its numbers, in the order of the struct.
inline constexpr std::tuple placed_rows{
    FieldOf<PlacedMembrane, std::string>{{"name", "", "", {},
      "Name of the membrane in plots and tables."}, &PlacedMembrane::name},
    FieldOf<PlacedMembrane, Membrane>{{"membrane", "", "", {}, "K06's four numbers."}, &PlacedMembrane::membrane},
    FieldOf<PlacedMembrane, std::array<double, 3>>{{"point", "a", "m", {},
      "Any point of the surface that the needle enters.", in_unit("mm")}, &PlacedMembrane::point},
    FieldOf<PlacedMembrane, std::array<double, 3>>{{"inward_normal", "n", "-", {},
      "Direction into the membrane, of any length but 0."}, &PlacedMembrane::inward_normal},
    FieldOf<PlacedMembrane, Behind>{{"behind", "", "", {},
      "Content of the space between this membrane and the next. It does not grip the needle. Blood shows in the "
      "needle's hub while the tip is in it."}, &PlacedMembrane::behind},
    FieldOf<PlacedMembrane, Look>{{"look", "", "", {},
      "Kind of tissue in the picture; plain is a sheet of glass. It has no effect on the force."},
      &PlacedMembrane::look},
    FieldOf<PlacedMembrane, Outlet>{{"outflow", "", "", {},
      "What liquid from the needle's syringe meets in the membrane."}, &PlacedMembrane::outflow},
    FieldOf<PlacedMembrane, Outlet>{{"outflow_behind", "", "", {},
      "The same for the space behind it."}, &PlacedMembrane::outflow_behind},
    FieldOf<PlacedMembrane, Tissue>{{"tissue", "", "", {},
      "What measured tissue adds to the membrane; nothing in K06."}, &PlacedMembrane::tissue},
};

/// What a scene has beside its tables.
inline constexpr FieldOf<Scene, std::string> scene_name_field{{"name", "", "", {}, "Name of the scene."}, &Scene::name};
inline constexpr FieldOf<Scene, Direction> direction_field{
    {"direction", "b", "", {},
     "Source of the needle's direction at entry: the device's stylus, or the motion of the tip for devices without "
     "orientation."},
    &Scene::direction};
inline constexpr FieldOf<Scene, std::vector<MaxwellBranch>> relaxation_field{
    {"relaxation", "", "", {}, "The branches beside the coupling that relax while the needle rests; empty in K06."},
    &Scene::relaxation};
// clang-format on

}  // namespace punctura
