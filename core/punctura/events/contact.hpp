// Detects the events at one membrane, tick by tick.
#pragma once

#include <cmath>
#include <cstdint>

#include "punctura/events/crossing.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

/// The kind of an event at a membrane.
enum class EventKind : std::uint8_t {
  touch,  ///< the tip enters the membrane
  pop,    ///< the whole tip, with its slanted face, has passed the membrane
  out,    ///< the tip has left the membrane
};

/// Follows the tip at one membrane and reports each event once.
///
/// After a pop, the tip must come back to the depth Crossing::again before the next pop. After a touch, there must be
/// an `out` before the next touch.
///
/// A tick without a depth changes nothing. A barred membrane has no pop, and the needle must enter it again.
class Contact {
 public:
  /// m. At this distance in front of the surface, the tip is out. The tremor of a hand is smaller.
  static constexpr double clear = 0.25e-3;

  /// One tick. enter() returns the Crossing of the membrane for the present direction of the needle. found(kind,
  /// force_before, force_after) receives each event.
  template <typename Enter, typename Found>
  void step(const MembraneRecord& now, Enter&& enter, Found&& found) noexcept {
    if (!std::isfinite(now.depth)) return;
    if (!friction_acts(now.phase)) {
      inside_ = false;
      if (now.phase == Phase::outside && touched_ && now.depth <= -clear) {
        touched_ = false;
        found(EventKind::out, 0.0, 0.0);
      }
      return;
    }
    if (!inside_) {
      crossing_ = enter();
      inside_ = true;
      allow_pop();
    }
    if (!touched_) {
      touched_ = true;
      found(EventKind::touch, 0.0, 0.0);
    }
    if (!can_pop_ && now.depth <= crossing_.again) allow_pop();
    if (!can_pop_) return;
    const double resistance = -now.axial_force;
    peak_ = std::fmax(peak_, resistance);  // fmax ignores NaN
    if (!(now.depth >= crossing_.through)) return;
    can_pop_ = false;
    const double friction = std::isfinite(now.lower) ? -now.lower : resistance;
    const bool falls_on = crossing_.settled > crossing_.through;  // a tail: the shaft alone comes behind it
    found(EventKind::pop, peak_, std::isfinite(friction) && !falls_on ? friction : crossing_.shaft);
  }

  /// Changes the law of the membrane. enter(cos_beta) returns its Crossing.
  template <typename Enter>
  void change_law(Enter&& enter) noexcept {
    if (inside_) crossing_ = enter(crossing_.cos_beta);
  }

 private:
  /// Whether friction acts. False for a number that is no phase: a recording has 255 if a tick does not have the
  /// membrane.
  static bool friction_acts(Phase phase) noexcept { return phase <= Phase::barred && inside(phase); }

  void allow_pop() noexcept {
    can_pop_ = true;
    peak_ = 0;
  }

  bool touched_ = false;  // there was a touch, and no out since
  bool inside_ = false;   // crossing_ is valid
  bool can_pop_ = false;
  double peak_ = 0;  // N, the largest resistance since allow_pop()
  Crossing crossing_{};
};

}  // namespace punctura
