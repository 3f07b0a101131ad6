// One proxy for each membrane behind one conditioning of the position. K06 Fig. 8
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "punctura/model/field.hpp"
#include "punctura/model/storage.hpp"
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

/// Calls resume(now[i], before[j]) for each pair of elements at the same place (`same_place`). If several elements
/// share a place, they are paired in their order. An element at a new place has no pair. It allocates no memory.
template <typename Now, typename Before, typename Resume>
constexpr void match_by_place(Now& now, const Before& before, Resume&& resume) noexcept {
  for (auto one = now.begin(); one != now.end(); ++one) {
    const auto here = [&](const auto& other) { return one->same_place(other); };
    auto skip = std::count_if(now.begin(), one, here);
    for (const auto& old : before)
      if (here(old) && skip-- == 0) {
        resume(*one, old);
        break;
      }
  }
}

/// What all models of an insertion share: it conditions the position, steps one proxy for each membrane and adds their
/// forces in the order of the membranes. A derived class fills `proxies_` in its constructor and then calls reset().
///
/// Proxies: a vector of proxies, or a std::variant of two kinds of such vectors. The step of a proxy,
/// `step_finite(position, axis)`, returns the force, N; a proxy also has reset(), resume(), same_place(), phase(),
/// tick() and state(), as those of Proxy3d.
template <typename Scalar_, typename Proxies_, typename Storage>
class ConditionedProxies {
 public:
  using Scalar = Scalar_;
  using Vector = Vector3<Scalar>;
  using Proxies = Proxies_;
  using StoredIn = Storage;

  /// Clears all state. A proxy that starts inside a membrane stays barred until it has been outside, in front.
  constexpr void reset() noexcept {
    conditioner_.reset();
    if (from_motion_) from_motion_->reset();
    each(proxies_, [](auto& proxy) { proxy.reset(); });
    tip_.setZero();
    force_.setZero();
  }

  /// Takes over the state of another insertion of the same period, which may have other laws and another coupling.
  /// `previous` loses its history. Allocates no memory.
  ///
  /// Each membrane takes over the state of the membrane at the same place, also if its number differs. If several
  /// membranes are at one place, the first takes over from the first, the second from the second. A membrane at a new
  /// place starts without history.
  template <typename Others>
  constexpr void resume(ConditionedProxies<Scalar, Others, Storage>& previous) noexcept {
    conditioner_.resume(previous.conditioner_);
    if (from_motion_ && previous.from_motion_) std::swap(*from_motion_, *previous.from_motion_);
    tip_ = previous.tip_;
    visit(proxies_, [&](auto& now) {
      visit(previous.proxies_, [&](auto& before) {
        match_by_place(now, before, [](auto& proxy, const auto& old) { proxy.resume(old); });
      });
    });
  }

  /// One tick. position: measured, m. axis: the needle's unit direction. Returns the force on the device, N.
  ///
  /// It returns NaN, and the state does not change, if position is NaN or beyond 1000 km. The same holds if axis is
  /// used and not finite.
  constexpr Vector step(const Vector& position, const Vector& axis) noexcept {
    return visit(proxies_, [&](auto& proxies) { return step(proxies, position, axis); });
  }

  static void archive(auto& self, auto& state) {
    state.fields(self.conditioner_);
    if (self.from_motion_) state.fields(*self.from_motion_);
    each(self.proxies_, [&](auto& proxy) { state.fields(proxy); });
    state.fields(self.tip_, self.force_);
  }
  void describe(auto& parameters) const {
    conditioner_.describe(parameters);
    parameters.flag(uses_axis());
    if (from_motion_) from_motion_->describe(parameters);
    parameters.index(sub_steps_, 0);
    each(proxies_, [&](const auto& proxy) { proxy.describe(parameters); });
  }

  constexpr const Vector& tip() const noexcept { return tip_; }        ///< the conditioned position, m
  constexpr const Vector& force() const noexcept { return force_; }    ///< the sum of all membranes, N
  constexpr bool uses_axis() const noexcept { return !from_motion_; }  ///< whether step() reads the axis
  constexpr const Proxies& proxies() const noexcept { return proxies_; }
  constexpr std::size_t size() const noexcept {  ///< the number of membranes
    return visit(proxies_, [](const auto& proxies) { return proxies.size(); });
  }
  /// The result of the last tick at membrane i.
  constexpr SpaceTick<Scalar> tick(std::size_t i) const noexcept {
    return visit(proxies_, [i](const auto& proxies) { return proxies[i].tick(); });
  }
  /// n.b of the needle in membrane i, constant while the needle is inside.
  constexpr Scalar cos_beta(std::size_t i) const noexcept {
    return visit(proxies_, [i](const auto& proxies) { return proxies[i].state().cos_beta; });
  }

  /// Whether the tip is in front of every membrane. Forces may be switched on only in this state.
  constexpr bool outside() const noexcept {
    bool all = true;
    each(proxies_, [&](const auto& proxy) { all = all && proxy.phase() == Phase::outside; });
    return all;
  }

  /// Calls visitor(proxies) with the vector in use, and returns its result. Of two kinds, one comparison finds it.
  template <typename Visitor>
  static constexpr decltype(auto) visit(auto& proxies, Visitor&& visitor) {
    if constexpr (requires { proxies.size(); })
      return visitor(proxies);
    else if (auto* first = std::get_if<0>(&proxies))
      return visitor(*first);
    else
      return visitor(*std::get_if<1>(&proxies));
  }

 protected:
  /// The arguments of InsertionOf.
  constexpr ConditionedProxies(Scalar period, Scalar low_pass_hz, Direction direction, Conditioning conditioning,
                               Scalar encoder_step, std::uint32_t sub_steps)
      : conditioner_(conditioning, low_pass_hz, encoder_step, period), sub_steps_(sub_steps) {
    if (direction == Direction::motion) from_motion_.emplace(period);
  }
  /// Goes on from an insertion with one of these kinds of proxies.
  template <typename One>
  constexpr explicit ConditionedProxies(ConditionedProxies<Scalar, One, Storage>&& one)
      : proxies_(std::move(one.proxies_)),
        conditioner_(std::move(one.conditioner_)),
        from_motion_(std::move(one.from_motion_)),
        sub_steps_(one.sub_steps_),
        tip_(one.tip_),
        force_(one.force_) {}

  Proxies proxies_;

 private:
  template <typename, typename, typename>
  friend class ConditionedProxies;
  static constexpr void each(auto& proxies, auto&& act) {
    visit(proxies, [&](auto& all) {
      for (auto& proxy : all) act(proxy);
    });
  }
  using Conditioner = PositionConditioner<Scalar, Storage>;
  using Tracker = EntryDirection<Scalar, Storage>;

  /// The kind of the proxies is chosen once, in front of the tick.
  constexpr Vector step(auto& proxies, const Vector& position, const Vector& axis) noexcept {
    const Vector no_number = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    if (!is_place(position) || (uses_axis() && !axis.allFinite())) return no_number;
    const bool first = !conditioner_.started();
    const Vector tip = conditioner_.step(position);
    Vector of_motion;
    if (from_motion_) of_motion = from_motion_->step(tip);
    const Vector& direction = from_motion_ ? of_motion : axis;
    if (sub_steps_ > 1 && !first) step_between(proxies, tip, direction);
    tip_ = tip;
    Vector force;
    for (auto& proxy : proxies) force += proxy.step_finite(tip, direction);
    return force_ = force;
  }
  /// The sub-steps of a tick without the last one, from the last tip to this one (m).
  constexpr void step_between(auto& proxies, const Vector& tip, const Vector& direction) noexcept {
    for (std::uint32_t i = 1; i < sub_steps_; ++i) {
      const Vector between = tip_ + (static_cast<Scalar>(i) / static_cast<Scalar>(sub_steps_)) * (tip - tip_);
      for (auto& proxy : proxies) proxy.step_finite(between, direction);
    }
  }

  Conditioner conditioner_;
  std::optional<Tracker> from_motion_;  ///< empty for Direction::stylus
  std::uint32_t sub_steps_;
  Vector tip_ = Vector::Zero(), force_ = Vector::Zero();
};

}  // namespace punctura
