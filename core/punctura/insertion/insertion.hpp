// K06 Fig. 8: a needle through several membranes, one proxy and one coupling each.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "punctura/model/storage.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/signal/conditioning.hpp"
#include "punctura/signal/entry_direction.hpp"

namespace punctura {

/// Where a membrane takes the needle's direction b from, at entry.
enum class Direction : std::uint8_t {
  stylus,  ///< the measured orientation of the device
  motion,  ///< the way the tip has come (EntryDirection): for devices without orientation
};

/// A membrane in its place: law, a point of its surface (m), inward normal (of length 1).
template <ObliqueLaw L>
struct SiteOf {
  L law;
  Vector3<typename L::Scalar> point, inward_normal;
};

/// The model from measured position to force: position conditioning, one proxy a membrane, their sum in scene order. K06 (41), Fig. 8.
///
/// It knows nothing of devices and safety: the force is the model's own. All memory is taken at construction. L: the membranes' law,
/// which may be a MixedLaw. C: the coupling. Storage: HeapStorage, or FixedStorage for a machine without a heap, whose bounds end the
/// program where the sites or the rate are beyond them.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>, typename Storage = HeapStorage>
class InsertionOf {
 public:
  using Scalar = typename L::Scalar;
  using Vector = Vector3<Scalar>;
  using Proxy = Proxy3d<L, C>;
  using Proxies = typename Storage::template Membranes<Proxy>;

  InsertionOf(std::span<const SiteOf<L>> sites, const C& coupling, Scalar period, Solver solver = Solver::exact,
              Scalar low_pass_hz = 0, Direction direction = Direction::stylus,
              Conditioning conditioning = Conditioning::low_pass, Scalar encoder_step = 0)
      : conditioner_(conditioning, low_pass_hz, encoder_step, period), from_motion_(tracker(direction, period)) {
    proxies_.reserve(sites.size());
    for (const auto& site : sites) proxies_.emplace_back(site.law, site.point, site.inward_normal, coupling, solver);
    reset();
  }

  InsertionOf(std::span<const SiteOf<L>> sites, const BasicCoupling<Scalar>& coupling, Scalar period,
              Solver solver = Solver::exact)
      : InsertionOf(sites, C(coupling, period), period, solver) {}

  void reset() noexcept {
    conditioner_.reset();
    if (from_motion_) from_motion_->reset();
    for (Proxy& proxy : proxies_) proxy.reset();
    tip_.setZero();
    force_.setZero();
  }

  /// Goes on from where another insertion of the same period is, which loses its history. Each membrane goes on from the
  /// one in the same place, whatever its number; of several in one place, the first from the first. A membrane in a new place
  /// starts afresh. Takes no memory.
  void resume(InsertionOf& previous) noexcept {
    conditioner_.resume(previous.conditioner_);
    if (from_motion_ && previous.from_motion_) from_motion_->resume(*previous.from_motion_);
    for (std::size_t i = 0; i < proxies_.size(); ++i) {
      std::size_t before = same_before(i);
      for (const Proxy& other : previous.proxies_)
        if (proxies_[i].same_place(other) && before-- == 0) {
          proxies_[i].resume(other);
          break;
        }
    }
  }

  /// One tick: measured position (m) and unit direction of the needle give the force on the device (N). A position that is no
  /// place (NaN, or beyond 1000 km), or an axis that is used and not finite, gives NaN, and the insertion is as if that tick had not been.
  Vector step(const Vector& position, const Vector& axis) noexcept {
    const Vector no_number = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());
    if (!is_place(position) || (uses_axis() && !axis.allFinite())) return no_number;
    tip_ = conditioner_.step(position);
    const Vector direction = from_motion_ ? from_motion_->step(tip_) : axis;
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
    for (const Proxy& proxy : proxies_) proxy.describe(parameters);
  }

  const Vector& tip() const noexcept { return tip_; }      ///< the conditioned position, m
  const Vector& force() const noexcept { return force_; }  ///< the sum of all membranes, N
  bool uses_axis() const noexcept { return !from_motion_; }
  const Proxies& proxies() const noexcept { return proxies_; }

  /// Whether the tip is in front of every membrane: the only state in which forces may be switched on.
  bool outside() const noexcept {
    for (const Proxy& proxy : proxies_)
      if (proxy.phase() != Phase::outside) return false;
    return true;
  }

 private:
  using Conditioner = PositionConditioner<Scalar, Storage>;
  using Tracker = EntryDirection<Scalar, Storage>;

  /// How many proxies before the i-th are in its place.
  std::size_t same_before(std::size_t i) const noexcept {
    const auto first = proxies_.begin();
    return static_cast<std::size_t>(std::count_if(first, first + static_cast<std::ptrdiff_t>(i),
                                                  [&](const Proxy& other) { return other.same_place(proxies_[i]); }));
  }
  /// None where the device gives the direction.
  static std::optional<Tracker> tracker(Direction direction, Scalar period) {
    if (direction == Direction::motion) return std::make_optional<Tracker>(period);
    return std::nullopt;
  }

  Conditioner conditioner_;
  std::optional<Tracker> from_motion_;
  Proxies proxies_;
  Vector tip_ = Vector::Zero(), force_ = Vector::Zero();
};

/// With K06's law and coupling.
template <typename Scalar>
using MembraneSite = SiteOf<BasicThickLaw<Scalar>>;
template <typename Scalar>
using BasicInsertion = InsertionOf<BasicThickLaw<Scalar>>;
using Insertion = BasicInsertion<double>;
using InsertionF = BasicInsertion<float>;

}  // namespace punctura
