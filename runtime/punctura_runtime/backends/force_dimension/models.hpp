// Data of Force Dimension's devices, by type, that their libraries do not give.
#pragma once

#include "punctura/device/device.hpp"

namespace punctura::force_dimension {

/// The maker's ratings of the family; NaN if not known. Continuous ratings are not published.
struct Model {
  double max_force = unknown;      ///< N
  double max_stiffness = unknown;  ///< N/m
  unsigned buttons = 1;
};

inline constexpr Model omega{12, 5000, 1}, sigma{12, 4000, 1}, lambda{12, 8000, 1}, falcon{8, 3000, 4};

/// The library's type numbers. Two numbers with the same name are the right-handed and the left-handed device.
struct NumberedModel {
  int system_type;
  Model model;
};
inline constexpr NumberedModel models[] = {
    {33, omega},                                               // omega.3
    {34, omega},   {36, omega},   {35, omega},   {37, omega},  // omega.6, omega.7
    {206, sigma},  {104, sigma},  {105, sigma},                // sigma.3, sigma.7
    {203, lambda}, {131, lambda}, {132, lambda},               // lambda.3, lambda.6
    {108, lambda}, {109, lambda},                              // lambda.7
    {60, falcon},                                              // Novint Falcon
};

/// Nothing is known of other types, for example delta.3 (63).
constexpr Model model_of(int system_type) noexcept {
  for (const NumberedModel& known : models)
    if (known.system_type == system_type) return known.model;
  return {};
}

}  // namespace punctura::force_dimension
