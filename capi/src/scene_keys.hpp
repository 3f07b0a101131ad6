// Made by tools/make_scene_keys.py, from the schema of scene files in python/punctura/scene.
#pragma once

// clang-format off
#include <string_view>

namespace punctura::c {

/// What a key holds.
enum class KeyKind { number, number_or_word, vector, column, word, gauge };

/// A key of a scene file. A value in SI units is the number in the file times `digits` times 10^exponent.
struct SceneKey {
  std::string_view table, key;
  std::string_view name;  ///< in the core; a column has [] in place of the row: "profile[].depth"
  KeyKind kind;
  bool has_default;
  std::string_view digits;
  int exponent;
};

inline constexpr SceneKey scene_keys[] = {
    {"", "name", "name", KeyKind::word, false, "1", 0},
    {"needle", "diameter_mm", "diameter", KeyKind::number, false, "1", -3},
    {"needle", "gauge", "diameter", KeyKind::gauge, false, "1", 0},
    {"needle", "tip_angle_rad", "tip_angle", KeyKind::number, false, "1", 0},
    {"needle", "tip_angle_deg", "tip_angle",
     KeyKind::number, false, "17453292519943295769236907684886127134428718885417", -51},
    {"needle", "direction", "direction", KeyKind::word, true, "1", 0},
    {"coupling", "stiffness_N_per_mm", "stiffness", KeyKind::number, false, "1", 3},
    {"coupling", "damping_Ns_per_mm", "damping", KeyKind::number, false, "1", 3},
    {"coupling", "relaxation_stiffness_N_per_mm", "relaxation[].stiffness", KeyKind::column, true, "1", 3},
    {"coupling", "relaxation_time_constant_s", "relaxation[].time_constant", KeyKind::column, true, "1", 0},
    {"servo", "rate_hz", "rate", KeyKind::number, true, "1", 0},
    {"servo", "low_pass_hz", "low_pass", KeyKind::number, true, "1", 0},
    {"servo", "solver", "solver", KeyKind::word, true, "1", 0},
    {"servo", "conditioning", "conditioning", KeyKind::word, true, "1", 0},
    {"servo", "encoder_step_mm", "encoder_step", KeyKind::number, true, "1", -3},
    {"servo", "sub_steps", "sub_steps", KeyKind::number, true, "1", 0},
    {"display", "force_scale", "force_scale", KeyKind::number_or_word, true, "1", 0},
    {"syringe", "bore_mm", "bore", KeyKind::number, false, "1", -3},
    {"syringe", "liquid_mL", "liquid", KeyKind::number, false, "1", -6},
    {"syringe", "air_mL", "air", KeyKind::number, true, "1", -6},
    {"syringe", "friction_N", "friction", KeyKind::number, false, "1", 0},
    {"syringe", "compliance_mL_per_kPa", "compliance", KeyKind::number, false, "1", -9},
    {"syringe", "resistance_kPa_s_per_mL", "resistance", KeyKind::number, false, "1", 9},
    {"syringe", "thumb_stiffness_N_per_mm", "thumb_stiffness", KeyKind::number, true, "1", 3},
    {"syringe", "thumb_damping_Ns_per_mm", "thumb_damping", KeyKind::number, true, "1", 3},
    {"membrane", "name", "name", KeyKind::word, false, "1", 0},
    {"membrane", "stiffness_N_per_mm", "stiffness", KeyKind::number, false, "1", 3},
    {"membrane", "precompression_N", "precompression", KeyKind::number, false, "1", 0},
    {"membrane", "friction", "friction", KeyKind::number, false, "1", 0},
    {"membrane", "thickness_mm", "thickness", KeyKind::number, false, "1", -3},
    {"membrane", "point_mm", "point", KeyKind::vector, false, "1", -3},
    {"membrane", "inward_normal", "inward_normal", KeyKind::vector, false, "1", 0},
    {"membrane", "look", "look", KeyKind::word, true, "1", 0},
    {"membrane", "behind", "behind", KeyKind::word, true, "1", 0},
    {"membrane", "outflow_resistance_kPa_s_per_mL", "outflow_resistance", KeyKind::number, true, "1", 9},
    {"membrane", "outflow_pressure_kPa", "outflow_pressure", KeyKind::number, true, "1", 3},
    {"membrane", "behind_resistance_kPa_s_per_mL", "behind_resistance", KeyKind::number, true, "1", 9},
    {"membrane", "behind_pressure_kPa", "behind_pressure", KeyKind::number, true, "1", 3},
    {"membrane", "grip", "grip", KeyKind::word, true, "1", 0},
    {"membrane", "growth_per_mm", "growth", KeyKind::number, true, "1", 3},
    {"membrane", "grip_opening_mm", "grip_table[].opening", KeyKind::column, true, "1", -3},
    {"membrane", "grip_force_N", "grip_table[].grip", KeyKind::column, true, "1", 0},
    {"membrane", "tip_length_mm", "tip_length", KeyKind::number, true, "1", -3},
    {"membrane", "tail_length_mm", "tail_length", KeyKind::number, true, "1", -3},
    {"membrane", "tail_floor", "tail_floor", KeyKind::number, true, "1", 0},
    {"membrane", "cutting_N", "cutting", KeyKind::number, true, "1", 0},
    {"membrane", "set", "set", KeyKind::number, true, "1", 0},
    {"membrane", "profile_depth_mm", "profile[].depth", KeyKind::column, true, "1", -3},
    {"membrane", "profile_lower_N", "profile[].lower", KeyKind::column, true, "1", 0},
    {"membrane", "profile_upper_N", "profile[].upper", KeyKind::column, true, "1", 0},
};

/// A needle's gauge and its outer diameter, m. ISO 9626
struct GaugeDiameter {
  long long gauge;
  std::string_view digits;
  int exponent;
};

inline constexpr GaugeDiameter gauge_diameters[] = {
    {10, "34", -4},
    {11, "3", -3},
    {12, "27", -4},
    {13, "24", -4},
    {14, "21", -4},
    {15, "18", -4},
    {16, "16", -4},
    {17, "14", -4},
    {18, "12", -4},
    {19, "11", -4},
    {20, "9", -4},
    {21, "8", -4},
    {22, "7", -4},
    {23, "6", -4},
    {24, "55", -5},
    {25, "5", -4},
    {26, "45", -5},
    {27, "4", -4},
    {28, "36", -5},
    {29, "33", -5},
    {30, "3", -4},
    {31, "25", -5},
    {32, "23", -5},
    {33, "2", -4},
    {34, "18", -5},
};

}  // namespace punctura::c
