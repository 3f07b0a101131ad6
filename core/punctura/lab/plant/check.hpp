// The permitted values of a simulated device, hand and strokes.
#pragma once

#include "punctura/lab/plant/device_dynamics.hpp"
#include "punctura/lab/plant/hand.hpp"
#include "punctura/lab/plant/motion.hpp"
#include "punctura/model/validity.hpp"

namespace punctura {

namespace detail {
inline constexpr Range greater_than_0{0, no_bound, true, true, "must be greater than 0"};
inline constexpr Range at_least_0{0, no_bound, false, true, "must be 0 or more"};
}  // namespace detail

inline constexpr FieldOf<DeviceDynamics> plant_fields[] = {
    {{"mass", "", "kg", detail::greater_than_0}, &DeviceDynamics::mass},
    {{"friction", "", "N", detail::at_least_0}, &DeviceDynamics::friction},
    {{"encoder_step", "", "m", detail::at_least_0}, &DeviceDynamics::encoder_step},
    {{"max_force", "", "N", detail::at_least_0}, &DeviceDynamics::max_force},
};

inline constexpr FieldOf<Hand> hand_fields[] = {
    {{"mass", "", "kg", detail::at_least_0}, &Hand::mass},
    {{"damping", "", "N s/m", detail::at_least_0}, &Hand::damping},
    {{"stiffness", "", "N/m", detail::at_least_0}, &Hand::stiffness},
    {{"tremor_rms", "", "m", detail::at_least_0}, &Hand::tremor_rms},
    {{"tremor_hz", "", "Hz", detail::greater_than_0}, &Hand::tremor_hz},
};

inline constexpr FieldOf<Strokes> strokes_fields[] = {
    {{"duration", "", "s", detail::greater_than_0}, &Strokes::duration},
    {{"rest", "", "s", detail::at_least_0}, &Strokes::rest},
    {{"variation", "", "-", detail::at_least_0}, &Strokes::variation},
};

}  // namespace punctura
