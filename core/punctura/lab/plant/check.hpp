// The permitted values of a simulated device, hand and strokes.
#pragma once

#include "punctura/lab/plant/hand.hpp"
#include "punctura/lab/plant/motion.hpp"
#include "punctura/model/validity.hpp"

namespace punctura {

inline constexpr FieldOf<DeviceDynamics> plant_fields[] = {
    {{"mass", "", "kg", greater_than_0, "Apparent mass."}, &DeviceDynamics::mass},
    {{"friction", "", "N", at_least_0, "Dry friction."}, &DeviceDynamics::friction},
    {{"encoder_step", "", "m", at_least_0, "0 for an ideal sensor."}, &DeviceDynamics::encoder_step},
    {{"max_force", "", "N", at_least_0, "Saturation."}, &DeviceDynamics::max_force},
};

inline constexpr FieldOf<Hand> hand_fields[] = {
    {{"mass", "", "kg", at_least_0}, &Hand::mass},
    {{"damping", "", "N s/m", at_least_0}, &Hand::damping},
    {{"stiffness", "", "N/m", at_least_0}, &Hand::stiffness},
    {{"tremor_rms", "", "m", at_least_0, "Along each axis; 0 for none."}, &Hand::tremor_rms},
    {{"tremor_hz", "", "Hz", greater_than_0, "Frequency of the tremor."}, &Hand::tremor_hz},
};

inline constexpr std::tuple strokes_rows{
    FieldOf<Strokes, Vector3d>{{"start", "", "m"}, &Strokes::start},
    FieldOf<Strokes, Vector3d>{{"end", "", "m"}, &Strokes::end},
    FieldOf<Strokes, std::size_t>{{"count", "", "", {}, "Number of strokes there and back."}, &Strokes::count},
    FieldOf<Strokes>{{"duration", "", "s", greater_than_0, "Of one way."}, &Strokes::duration},
    FieldOf<Strokes>{{"rest", "", "s", at_least_0, "At both ends."}, &Strokes::rest},
    FieldOf<Strokes>{
        {"variation", "", "-", at_least_0, "Relative standard deviation of depth and duration between strokes."},
        &Strokes::variation},
};
inline constexpr auto strokes_fields = numbers_of(strokes_rows);

inline void check(const Strokes& strokes, std::vector<Problem>& problems) {
  for (const auto& [name, point] : {std::pair{"strokes.start", strokes.start}, std::pair{"strokes.end", strokes.end}})
    for (std::size_t i = 0; i < 3; ++i)
      if (!is_place(point[i]))
        problems.push_back({name + ("[" + std::to_string(i) + "]"), point[i], "must be finite and within 1000 km"});
  check_fields(strokes_fields, strokes, "strokes", problems);
}

}  // namespace punctura
