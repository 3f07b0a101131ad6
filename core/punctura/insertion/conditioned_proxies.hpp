// One proxy for each membrane behind one conditioning of the position. K06 Fig. 8
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "punctura/insertion/match_by_place.hpp"
#include "punctura/model/storage.hpp"
#include "punctura/model/words.hpp"
#include "punctura/proxy/in_space.hpp"
#include "punctura/signal/conditioning.hpp"
#include "punctura/signal/entry_direction.hpp"

namespace punctura {

/// The source of the needle's direction b at entry.
enum class Direction : std::uint8_t {
  stylus,  ///< the measured orientation of the device
  motion,  ///< the direction of the tip's motion (EntryDirection), for devices without orientation
};
template <>
inline constexpr std::array<std::string_view, 2> words_of<Direction>{"stylus", "motion"};

/// What all models of an insertion share: it conditions the position, steps one proxy for each membrane and adds their
/// forces in the order of the membranes. A derived class fills `proxies_` in its constructor and then calls reset().
///
/// Proxy: `step_finite(position, axis)` returns the force, N; also reset(), resume(), same_place(), phase(), tick() and
/// state(), as Proxy3d has them.
template <typename Proxy, typename Storage>
class ConditionedProxies {
 public:
  using Scalar = typename Proxy::Scalar;
  using Vector = Vector3<Scalar>;
  using Proxies = typename Storage::template Membranes<Proxy>;
  using StoredIn = Storage;

  /// Clears all state. A proxy that starts inside a membrane stays barred until it has been outside, in front.
  void reset() noexcept {
    conditioner_.reset();
    if (from_motion_) from_motion_->reset();
    for (Proxy& proxy : proxies_) proxy.reset();
    tip_.setZero();
    force_.setZero();
  }

  /// Takes over the state of another insertion of the same period, which may have other laws and another coupling.
  /// `previous` loses its history. Allocates no memory.
  ///
  /// Each membrane takes over the state of the membrane at the same place, also if its number differs. If several
  /// membranes are at one place, the first takes over from the first, the second from the second. A membrane at a new
  /// place starts without history.
  template <typename OtherProxy>
  void resume(ConditionedProxies<OtherProxy, Storage>& previous) noexcept {
    conditioner_.resume(previous.conditioner_);
    if (from_motion_ && previous.from_motion_) std::swap(*from_motion_, *previous.from_motion_);
    tip_ = previous.tip_;
    match_by_place(proxies_, previous.proxies_, [](Proxy& proxy, const OtherProxy& old) { proxy.resume(old); });
  }

  /// One tick. position: measured, m. axis: the needle's unit direction. Returns the force on the device, N.
  ///
  /// It returns NaN, and the state does not change, if position is NaN or beyond 1000 km. The same holds if axis is
  /// used and not finite.
  Vector step(const Vector& position, const Vector& axis) noexcept {
    const Vector no_number = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    if (!is_place(position) || (uses_axis() && !axis.allFinite())) return no_number;
    const bool first = !conditioner_.started();
    const Vector tip = conditioner_.step(position);
    const Vector direction = from_motion_ ? from_motion_->step(tip) : axis;
    if (sub_steps_ > 1 && !first) step_between(tip, direction);
    tip_ = tip;
    Vector force;
    for (Proxy& proxy : proxies_) force += proxy.step_finite(tip, direction);
    return force_ = force;
  }

  static void archive(auto& self, auto& state) {
    Conditioner::archive(self.conditioner_, state);
    if (self.from_motion_) Tracker::archive(*self.from_motion_, state);
    for (auto& proxy : self.proxies_) Proxy::archive(proxy, state);
    state.numbers(self.tip_, self.force_);
  }
  void describe(auto& parameters) const {
    conditioner_.describe(parameters);
    parameters.flag(uses_axis());
    if (from_motion_) from_motion_->describe(parameters);
    parameters.index(sub_steps_, 0);
    for (const Proxy& proxy : proxies_) proxy.describe(parameters);
  }

  const Vector& tip() const noexcept { return tip_; }        ///< the conditioned position, m
  const Vector& force() const noexcept { return force_; }    ///< the sum of all membranes, N
  bool uses_axis() const noexcept { return !from_motion_; }  ///< whether step() reads the axis
  const Proxies& proxies() const noexcept { return proxies_; }
  std::size_t size() const noexcept { return proxies_.size(); }  ///< the number of membranes
  /// The result of the last tick at membrane i.
  SpaceTick<Scalar> tick(std::size_t i) const noexcept { return proxies_[i].tick(); }
  /// n.b of the needle in membrane i, constant while the needle is inside.
  Scalar cos_beta(std::size_t i) const noexcept { return proxies_[i].state().cos_beta; }

  /// Whether the tip is in front of every membrane. Forces may be switched on only in this state.
  bool outside() const noexcept {
    for (const Proxy& proxy : proxies_)
      if (proxy.phase() != Phase::outside) return false;
    return true;
  }

 protected:
  /// The arguments of InsertionOf.
  ConditionedProxies(Scalar period, Scalar low_pass_hz, Direction direction, Conditioning conditioning,
                     Scalar encoder_step, std::uint32_t sub_steps)
      : conditioner_(conditioning, low_pass_hz, encoder_step, period), sub_steps_(sub_steps) {
    if (direction == Direction::motion) from_motion_.emplace(period);
  }

  Proxies proxies_;

 private:
  template <typename, typename>
  friend class ConditionedProxies;
  using Conditioner = PositionConditioner<Scalar, Storage>;
  using Tracker = EntryDirection<Scalar, Storage>;

  /// The sub-steps of a tick without the last one, from the last tip to this one (m).
  void step_between(const Vector& tip, const Vector& direction) noexcept {
    for (std::uint32_t i = 1; i < sub_steps_; ++i) {
      const Vector between = tip_ + (static_cast<Scalar>(i) / static_cast<Scalar>(sub_steps_)) * (tip - tip_);
      for (Proxy& proxy : proxies_) proxy.step_finite(between, direction);
    }
  }

  Conditioner conditioner_;
  std::optional<Tracker> from_motion_;  ///< empty for Direction::stylus
  std::uint32_t sub_steps_;
  Vector tip_ = Vector::Zero(), force_ = Vector::Zero();
};

}  // namespace punctura
