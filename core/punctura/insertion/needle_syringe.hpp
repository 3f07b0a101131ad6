// The syringe on a needle: its plunger, and the outlet at the place where the needle's opening is.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>

#include "punctura/model/storage.hpp"
#include "punctura/syringe/plunger.hpp"
#include "punctura/syringe/syringe.hpp"

namespace punctura {

/// A membrane and the space behind it, as liquid from the needle meets them.
template <typename Scalar>
struct LayerOutlets {
  std::uint32_t membrane;  ///< its number in the scene
  Scalar thickness;        ///< H, m
  BasicOutlet<Scalar> inside, behind;
};

/// A plunger whose outlet follows the proxies of an insertion.
template <typename Scalar_, typename Storage = HeapStorage>
class NeedleSyringe {
 public:
  using Scalar = Scalar_;
  BasicPlunger<Scalar> plunger;

  /// opening: X, length of the needle's slanted face, m. layers: from the front to the back.
  constexpr NeedleSyringe(const BasicPlunger<Scalar>& of, Scalar opening, std::span<const LayerOutlets<Scalar>> layers)
      : plunger(of), opening_(opening) {
    layers_.reserve(layers.size());
    for (const auto& layer : layers) layers_.emplace_back(layer);
  }

  /// One tick, after the insertion's. thumb: depth of the thumb, m. Returns the force on the thumb, N.
  template <typename Insertion>
  constexpr Scalar step(Scalar thumb, const Insertion& insertion) noexcept {
    Opening<Scalar> opening(opening_);
    for (const auto& layer : layers_) {
      if (layer.membrane >= insertion.size()) std::abort();
      const auto& tick = insertion.tick(layer.membrane);
      // A barred wall gives the needle no force, but it is around the opening: its depth is along the normal.
      const Scalar U = inside(tick.phase) ? layer.thickness / insertion.cos_beta(layer.membrane)  // K06 (17)
                                          : layer.thickness;
      opening.pass({tick.phase == Phase::outside ? Scalar(0) : tick.depth, U, layer.inside, layer.behind});
    }
    return plunger.step(thumb, opening.outlet());
  }

  static void archive(auto& self, auto& state) { state.fields(self.plunger); }
  void describe(auto& parameters) const {
    plunger.describe(parameters);
    parameters.fields(opening_);
    for (const auto& layer : layers_) {
      parameters.index(layer.membrane, 0);
      parameters.fields(layer.thickness, layer.inside.resistance, layer.inside.pressure, layer.behind.resistance,
                        layer.behind.pressure);
    }
  }

 private:
  Scalar opening_;
  typename Storage::template Membranes<LayerOutlets<Scalar>> layers_;
};

}  // namespace punctura
