// A needle through several membranes, with one proxy and one coupling for each membrane. K06 Fig. 8
#pragma once

#include <cstdint>
#include <span>

#include "punctura/insertion/conditioned_proxies.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_3d.hpp"

namespace punctura {

/// A membrane with its position: the law, a point of the surface (m) and the inward normal (of length 1).
template <ObliqueLaw L>
struct SiteOf {
  L law;
  Vector3<typename L::Scalar> point, inward_normal;
};

/// The model of an insertion: it computes the force from the measured position. K06 (41), Fig. 8.
///
/// It contains no device and no safety limits: the force is the force of the model. All memory is allocated at
/// construction.
///
/// L: the law of the membranes; it can be a MixedLaw. C: the coupling. Storage: HeapStorage, or FixedStorage for a
/// machine without a heap. FixedStorage aborts the program if there are more sites, or a higher rate, than it has
/// room for.
template <ObliqueLaw L, typename C = SampledCoupling<typename L::Scalar>, typename Storage = HeapStorage>
class InsertionOf
    : public ConditionedProxies<typename L::Scalar, typename Storage::template Membranes<Proxy3d<L, C>>, Storage> {
 public:
  using Scalar = typename L::Scalar;

  /// coupling: sampled with the period of a sub-step, period / sub_steps. period: T, s. low_pass_hz: for
  /// Conditioning::low_pass; 0 is off. encoder_step: for Conditioning::line_fit, m. sub_steps: how many steps the
  /// proxies make in a tick, 1 or more; the position between two ticks is interpolated on a straight line.
  constexpr InsertionOf(std::span<const SiteOf<L>> sites, const C& coupling, Scalar period,
                        Solver solver = Solver::exact, Scalar low_pass_hz = 0, Direction direction = Direction::stylus,
                        Conditioning conditioning = Conditioning::low_pass, Scalar encoder_step = 0,
                        std::uint32_t sub_steps = 1)
      : InsertionOf::ConditionedProxies(period, low_pass_hz, direction, conditioning, encoder_step, sub_steps) {
    this->proxies_.reserve(sites.size());
    for (const auto& site : sites)
      this->proxies_.emplace_back(site.law, site.point, site.inward_normal, coupling, solver);
    this->reset();
  }

  constexpr InsertionOf(std::span<const SiteOf<L>> sites, const BasicCoupling<Scalar>& coupling, Scalar period,
                        Solver solver = Solver::exact)
      : InsertionOf(sites, C(coupling, period), period, solver) {}
};

/// A membrane with K06's law.
template <typename Scalar>
using MembraneSite = SiteOf<BasicThickLaw<Scalar>>;

}  // namespace punctura
