// What happens at one membrane, tick by tick.
#pragma once

#include <cmath>
#include <cstdint>

#include "punctura/events/crossing.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

enum class EventKind : std::uint8_t {
  touch,  ///< the model lets the tip in
  pop,    ///< the tip and its slanted face are through
  out,    ///< the tip has left the membrane
};

/// Follows the tip at one membrane. Gives each event once: after a pop the tip must come back to Crossing::again before it can pop
/// another time, after a touch it must have been out.
///
/// A tick without a depth changes nothing. A barred membrane has no pop, and the needle must enter it again.
class Contact {
 public:
  static constexpr double clear = 0.25e-3;  ///< m in front of the surface where the tip is out: a hand trembles less

  /// enter() gives the membrane's Crossing for the needle as it is. found(kind, force_before, force_after) takes each event.
  template <typename Enter, typename Found>
  void step(const MembraneRecord& now, Enter&& enter, Found&& found) noexcept {
    if (!std::isfinite(now.depth)) return;
    if (!grips(now.phase)) {
      inside_ = false;
      if (now.phase == Phase::outside && open_ && now.depth <= -clear) {
        open_ = false;
        found(EventKind::out, 0.0, 0.0);
      }
      return;
    }
    if (!inside_) {
      crossing_ = enter();
      inside_ = true;
      get_ready();
    }
    if (!open_) {
      open_ = true;
      found(EventKind::touch, 0.0, 0.0);
    }
    if (!ready_ && now.depth <= crossing_.again) get_ready();
    if (!ready_) return;
    const double resistance = -now.axial_force;
    strongest_ = std::fmax(strongest_, resistance);  // a NaN does not count
    if (!(now.depth >= crossing_.through)) return;
    ready_ = false;
    const double friction = std::isfinite(now.lower) ? -now.lower : resistance;
    found(EventKind::pop, strongest_, std::isfinite(friction) ? friction : crossing_.shaft);
  }

  /// The membrane has another law from now on. enter(cos_beta) gives its Crossing.
  template <typename Enter>
  void change_law(Enter&& enter) noexcept {
    if (inside_) crossing_ = enter(crossing_.cos_beta);
  }

 private:
  /// Whether friction acts. Not for a number that is no phase: a recording has 255 where a tick did not have the membrane.
  static bool grips(Phase phase) noexcept { return phase <= Phase::barred && inside(phase); }

  void get_ready() noexcept {
    ready_ = true;
    strongest_ = 0;
  }

  bool open_ = false;     // touched, and not out since
  bool inside_ = false;   // crossing_ counts
  bool ready_ = false;    // for a pop
  double strongest_ = 0;  // N, the largest resistance since get_ready()
  Crossing crossing_{};
};

}  // namespace punctura
