// The servo rate and the device of K06 section 4, a PHANTOM Omni. They are the defaults.
#pragma once

namespace punctura {

inline constexpr double usual_rate = 1600;  ///< 1/T, Hz. K06 section 4

/// A PHANTOM Omni: the nominal values of its data sheet (SensAble Technologies, about 2005).
///
/// The true values change over the workspace and with the direction.
struct Omni {
  static constexpr double mass = 0.045;             ///< kg, apparent at the tip
  static constexpr double friction = 0.26;          ///< N, dry friction of the drives
  static constexpr double encoder_step = 0.055e-3;  ///< m (450 dpi)
  static constexpr double max_force = 3.3;          ///< N, at the nominal position
  static constexpr double continuous_force = 0.88;  ///< N, for any time
};

}  // namespace punctura
