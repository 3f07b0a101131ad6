// The layers that the slanted opening of a needle lies in, as one outlet.
#pragma once

#include <algorithm>
#include <span>

#include "punctura/syringe/syringe.hpp"

namespace punctura {

/// A membrane under a needle: how far the point is in it, and what liquid meets in it and in the space behind it.
template <typename Scalar>
struct LayerAtTip {
  Scalar depth;        ///< of the point along the needle, m; 0 or less outside
  Scalar path_length;  ///< U, of the needle's path through the membrane, m
  BasicOutlet<Scalar> inside, behind;
};

/// Adds up the layers beside the opening of a needle, from the front to the back.
///
/// The opening is as long as the tip's slanted face. Each part of it leads into the layer beside it. These ways are
/// parallel: the flow is the sum of share_i (P - P_i) / R_i, with the share of layer i in the length. This is the flow
/// of one outlet with 1/R = sum share_i / R_i and P = R sum share_i P_i / R_i. So the resistance is lost gradually,
/// while the opening passes the far face of a layer.
template <typename Scalar>
class Opening {
 public:
  /// length: X, of the opening along the needle, m, more than 0.
  explicit Opening(Scalar length) noexcept : length_(length) {}

  /// The next layer to the back.
  void pass(const LayerAtTip<Scalar>& layer) noexcept {
    const Scalar entered = std::min(share(layer.depth), ahead_);
    const Scalar through = std::min(share(layer.depth - layer.path_length), entered);
    add(ahead_ - entered, here_);
    add(entered - through, layer.inside);
    here_ = layer.behind;
    ahead_ = through;
  }

  /// The outlet of all layers that were passed.
  BasicOutlet<Scalar> outlet() const noexcept {
    Opening all = *this;
    all.add(ahead_, here_);
    return {1 / all.conductance_, all.weighted_ / all.conductance_};
  }

 private:
  /// In open air only the cannula limits the flow. A finite number keeps the sum finite: a thousandth of a cannula.
  static constexpr Scalar open = Scalar(1e6);  // Pa s/m^3

  Scalar share(Scalar depth) const noexcept { return std::clamp(depth / length_, Scalar(0), Scalar(1)); }
  void add(Scalar share, const BasicOutlet<Scalar>& outlet) noexcept {
    const Scalar conducts = share / std::max(outlet.resistance, open);
    conductance_ += conducts;
    weighted_ += conducts * outlet.pressure;
  }

  Scalar length_, conductance_ = 0, weighted_ = 0;
  Scalar ahead_ = 1;                ///< the share of the opening behind the layers so far
  BasicOutlet<Scalar> here_{0, 0};  ///< the outlet of that share; in front of all layers open air
};

template <typename Scalar>
BasicOutlet<Scalar> outlet_at(std::span<const LayerAtTip<Scalar>> layers, Scalar length) noexcept {
  Opening<Scalar> opening(length);
  for (const auto& layer : layers) opening.pass(layer);
  return opening.outlet();
}

}  // namespace punctura
