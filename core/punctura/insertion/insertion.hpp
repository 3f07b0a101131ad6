// A needle through several membranes, with one proxy and one coupling for each membrane. K06 Fig. 8
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "punctura/insertion/match_by_place.hpp"
#include "punctura/model/storage.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/signal/conditioning.hpp"
#include "punctura/signal/entry_direction.hpp"

namespace punctura {

/// The source of the needle's direction b at entry.
enum class Direction : std::uint8_t {
  stylus,  ///< the measured orientation of the device
  motion,  ///< the direction of the tip's motion (EntryDirection), for devices without orientation
};

/// A membrane with its position: the law, a point of the surface (m) and the inward normal (of length 1).
template <ObliqueLaw L>
struct SiteOf {
  L law;
  Vector3<typename L::Scalar> point, inward_normal;
};

/// The model of an insertion: it computes the force from the measured position. K06 (41), Fig. 8.
///
/// It conditions the position, steps one proxy for each membrane and adds their forces in the order of the scene. It
/// contains no device and no safety limits: the force is the force of the model. All memory is allocated at
/// construction.
///
/// L: the law of the membranes; it can be a MixedLaw. C: the coupling. Storage: HeapStorage, or FixedStorage for a
/// machine without a heap. FixedStorage aborts the program if there are more sites, or a higher rate, than it has
/// room for.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>, typename Storage = HeapStorage>
class InsertionOf {
 public:
  using Scalar = typename L::Scalar;
  using Vector = Vector3<Scalar>;
  using Proxy = Proxy3d<L, C>;
  using Proxies = typename Storage::template Membranes<Proxy>;
  using StoredIn = Storage;

  /// coupling: sampled with the period of a sub-step, period / sub_steps. period: T, s. low_pass_hz: for
  /// Conditioning::low_pass; 0 is off. encoder_step: for Conditioning::line_fit, m. sub_steps: how many steps the
  /// proxies make in a tick, 1 or more; the position between two ticks is interpolated on a straight line.
  InsertionOf(std::span<const SiteOf<L>> sites, const C& coupling, Scalar period, Solver solver = Solver::exact,
              Scalar low_pass_hz = 0, Direction direction = Direction::stylus,
              Conditioning conditioning = Conditioning::low_pass, Scalar encoder_step = 0, std::uint32_t sub_steps = 1)
      : conditioner_(conditioning, low_pass_hz, encoder_step, period),
        from_motion_(tracker(direction, period)),
        sub_steps_(sub_steps) {
    proxies_.reserve(sites.size());
    for (const auto& site : sites) proxies_.emplace_back(site.law, site.point, site.inward_normal, coupling, solver);
    reset();
  }

  InsertionOf(std::span<const SiteOf<L>> sites, const BasicCoupling<Scalar>& coupling, Scalar period,
              Solver solver = Solver::exact)
      : InsertionOf(sites, C(coupling, period), period, solver) {}

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
  template <typename OtherLaw, typename OtherCoupling>
  void resume(InsertionOf<OtherLaw, OtherCoupling, Storage>& previous) noexcept {
    conditioner_.resume(previous.conditioner_);
    if (from_motion_ && previous.from_motion_) from_motion_->resume(*previous.from_motion_);
    tip_ = previous.tip_;
    match_by_place(proxies_, previous.proxies_, [](Proxy& proxy, const auto& old) { proxy.resume(old); });
  }

  /// One tick. position: measured, m. axis: the needle's unit direction. Returns the force on the device, N.
  ///
  /// It returns NaN, and the state does not change, if position is NaN or beyond 1000 km. The same holds if axis is
  /// used and not finite.
  Vector step(const Vector& position, const Vector& axis) noexcept {
    const Vector no_number = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    if (!is_place(position) || (uses_axis() && !axis.allFinite())) return no_number;
    const bool first = !conditioner_.started();
    const Vector before = tip_;
    tip_ = conditioner_.step(position);
    const Vector direction = from_motion_ ? from_motion_->step(tip_) : axis;
    if (sub_steps_ > 1 && !first) step_between(before, direction);
    force_.setZero();
    for (Proxy& proxy : proxies_) force_ += proxy.step_finite(tip_, direction);
    return force_;
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

 private:
  template <ObliqueLaw, typename, typename>
  friend class InsertionOf;
  using Conditioner = PositionConditioner<Scalar, Storage>;
  using Tracker = EntryDirection<Scalar, Storage>;

  /// Empty for Direction::stylus.
  static std::optional<Tracker> tracker(Direction direction, Scalar period) {
    if (direction == Direction::motion) return std::make_optional<Tracker>(period);
    return std::nullopt;
  }

  /// The sub-steps of a tick without the last one. before: the conditioned position of the last tick, m.
  void step_between(const Vector& before, const Vector& direction) noexcept {
    for (std::uint32_t i = 1; i < sub_steps_; ++i) {
      const Vector between = before + (static_cast<Scalar>(i) / static_cast<Scalar>(sub_steps_)) * (tip_ - before);
      for (Proxy& proxy : proxies_) proxy.step_finite(between, direction);
    }
  }

  Conditioner conditioner_;
  std::optional<Tracker> from_motion_;
  std::uint32_t sub_steps_;
  Proxies proxies_;
  Vector tip_ = Vector::Zero(), force_ = Vector::Zero();
};

/// A membrane with K06's law.
template <typename Scalar>
using MembraneSite = SiteOf<BasicThickLaw<Scalar>>;

}  // namespace punctura
