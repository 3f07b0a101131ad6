// Detects the events at one membrane, tick by tick.
#pragma once

#include <cstdint>
#include <type_traits>

#include "punctura/lab/events/crossing.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura {

enum class EventKind : std::uint8_t {
  touch,  ///< the tip enters the membrane
  pop,    ///< the whole tip, with its slanted face, has passed the membrane
  out,    ///< the tip has left the membrane
};

/// What Contact reads of a tick. Scalar: a number, or lanes.
template <typename Scalar>
struct ContactTick {
  Scalar depth;           ///< m, see SpaceTick::depth
  Scalar axial_force;     ///< N
  Scalar lower;           ///< of the band, N
  Mask<Scalar> acts;      ///< friction acts
  Mask<Scalar> in_front;  ///< the tip is in front of the surface
};

inline ContactTick<double> contact_tick(const MembraneRecord& now) noexcept {
  // A recording has 255, which is no phase, if a tick does not have the membrane.
  const bool acts = now.phase <= Phase::barred && inside(now.phase);
  return {now.depth, now.axial_force, now.lower, acts, now.phase == Phase::outside};
}

/// Follows the tip at one membrane and reports each event once.
///
/// After a pop, the tip must come back to the depth Crossing::again before the next pop. After a touch, there must be
/// an `out` before the next touch.
///
/// A tick without a depth changes nothing. A barred membrane has no pop, and the needle must enter it again.
template <typename Scalar>
class BasicContact {
 public:
  using Truth = Mask<Scalar>;
  /// m. At this distance in front of the surface, the tip is out. The tremor of a hand is smaller.
  static constexpr double clear = 0.25e-3;

  /// One tick. enter(lanes) returns the Crossing of the membrane for the present direction of the needle.
  /// found(kind, lanes, force_before, force_after) receives each event. lanes: true where it is wanted or happens.
  template <typename Enter, typename Found>
  void step(const ContactTick<Scalar>& now, Enter&& enter, Found&& found) noexcept {
    using namespace lane;
    const Truth known = now.depth - now.depth == 0;  // finite
    const Truth acts = known && now.acts, rests = known && !now.acts;
    const Truth leaves = rests && now.in_front && touched_ && now.depth <= Lane<Scalar>(-clear);
    if (any(leaves)) {
      touched_ = touched_ && !leaves;
      found(EventKind::out, leaves, Scalar(0), Scalar(0));
    }
    const Truth enters = acts && !inside_;
    inside_ = acts || (inside_ && !known);
    if (any(enters)) {
      crossing_ = select(enters, enter(enters), crossing_);
      allow_pop(enters);
    }
    const Truth touches = acts && !touched_;
    if (any(touches)) {
      touched_ = touched_ || touches;
      found(EventKind::touch, touches, Scalar(0), Scalar(0));
    }
    const Truth is_back = acts && !can_pop_ && now.depth <= crossing_.again;
    if (any(is_back)) allow_pop(is_back);
    const Truth can_pop = acts && can_pop_;
    const Scalar resistance = -now.axial_force;
    peak_ = select(can_pop && resistance > peak_, resistance, peak_);  // not NaN
    const Truth pops = can_pop && now.depth >= crossing_.through;
    if (!any(pops)) return;
    can_pop_ = can_pop_ && !pops;
    const Scalar friction = select(now.lower - now.lower == 0, Scalar(-now.lower), resistance);
    const Truth falls_on = crossing_.settled > crossing_.through;  // a tail: the shaft alone comes behind it
    const Truth is_number = friction - friction == 0;
    found(EventKind::pop, pops, peak_, select(is_number && !falls_on, friction, crossing_.shaft));
  }

  /// The same for the record of a tick: enter(), found(kind, force_before, force_after).
  template <typename Enter, typename Found>
  void step(const MembraneRecord& now, Enter&& enter, Found&& found) noexcept {
    step(
        contact_tick(now), [&](bool) { return enter(); },
        [&](EventKind kind, bool, double before, double after) { found(kind, before, after); });
  }

  /// Changes the law of the membrane. enter(cos_beta) returns its Crossing.
  template <typename Enter>
  void change_law(Enter&& enter) noexcept {
    if (inside_) crossing_ = enter(crossing_.cos_beta);
  }

  /// For save_state() and load_state() (state/archive.hpp). enter(cos_beta) returns the Crossing of the membrane.
  template <typename Enter>
  static void archive(auto& self, auto& state, Enter&& enter) {
    state.fields(self.touched_, self.inside_, self.can_pop_, self.peak_, self.crossing_.cos_beta);
    if constexpr (std::remove_reference_t<decltype(state)>::reading) self.change_law(enter);
  }

 private:
  void allow_pop(const Truth& lanes) noexcept {
    using namespace lane;
    can_pop_ = can_pop_ || lanes;
    peak_ = select(lanes, Scalar(0), peak_);
  }

  Truth touched_{false};  // there was a touch, and no out since
  Truth inside_{false};   // crossing_ is valid
  Truth can_pop_{false};
  Scalar peak_{0};  // N, the largest resistance since allow_pop()
  BasicCrossing<Scalar> crossing_{};
};
using Contact = BasicContact<double>;

}  // namespace punctura
