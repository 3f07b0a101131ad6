// The setup of K06 section 4, where the defaults come from: its servo rate and its device, a PHANTOM Omni.
#pragma once

namespace punctura {

inline constexpr double usual_rate = 1600;  ///< 1/T, Hz. K06 section 4

/// By its maker's data sheet (SensAble Technologies, about 2005). All values are nominal: the true ones change over the workspace and
/// with the direction.
struct Omni {
  static constexpr double mass = 0.045;             ///< kg, apparent at the tip
  static constexpr double friction = 0.26;          ///< N, dry, of the drives
  static constexpr double encoder_step = 0.055e-3;  ///< m (450 dpi)
  static constexpr double max_force = 3.3;          ///< N, at the nominal position
  static constexpr double continuous_force = 0.88;  ///< N, for as long as one likes
};

}  // namespace punctura
