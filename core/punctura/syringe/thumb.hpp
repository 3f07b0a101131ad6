// A simulated thumb on a plunger, for a key, a trigger or a wheel.
#pragma once

#include <algorithm>

namespace punctura {

/// A thumb that wants to push with a force. It moves in while the plunger pushes back less, and yields if more.
///
/// depth += T (wanted + f) / b: a viscous finger, which gives no energy of its own beyond the wanted force. It does not
/// draw: it never goes out further than where it began, whatever pressure pushes the plunger.
template <typename Scalar>
struct BasicThumb {
  Scalar viscosity = 100;  ///< b, N s/m: 3 N too much move it by 30 mm/s

  /// The next depth, m. depth: now, m. wanted: N, 0 or more. f: the plunger's force on the thumb, N, negative if it
  /// pushes back. period: T, s.
  Scalar step(Scalar depth, Scalar wanted, Scalar f, Scalar period) const noexcept {
    return std::max(Scalar(0), depth + period * (wanted + f) / viscosity);
  }
};

using Thumb = BasicThumb<double>;

/// The largest force that a simulated thumb may want, N. Illustrative.
inline constexpr double strongest_thumb = 15;

}  // namespace punctura
