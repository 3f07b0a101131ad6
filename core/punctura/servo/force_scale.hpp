// The force scale of a device that cannot give the forces of a scene: how much of the model's force it gives.
//
// These functions allocate memory. Do not call them in a tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "punctura/insertion/scene_insertion.hpp"
#include "punctura/model/law.hpp"
#include "punctura/proxy/in_space.hpp"
#include "punctura/safety/force_limits.hpp"

namespace punctura {

/// The part of the lasting force that the automatic scale uses. The rest is for a needle that enters at an angle of up
/// to 18 degrees to the first membrane's normal: its friction is at most 1 / cos(18 degrees) = 1.05 times as large.
inline constexpr double automatic_share = 0.95;

namespace detail {
template <typename Proxies>
double largest_force(const Proxies& proxies) {
  const auto& first = proxies[0].params();
  using Scalar = typename std::remove_cvref_t<decltype(first.law)>::Scalar;
  struct Layer {
    PiecesOf<std::remove_cvref_t<decltype(first.law)>> pieces;
    double surface;  // m along the needle, from the first membrane's surface
  };
  std::vector<Layer> layers;
  std::vector<double> depths;  // of all breaks, m along the needle
  for (const auto& proxy : proxies) {
    const auto& membrane = proxy.params();
    const Scalar cosine = membrane.n.dot(first.n);
    if (!(cosine >= grazing_cosine<Scalar>)) continue;
    const auto surface = static_cast<double>((membrane.a - first.a).dot(membrane.n) / cosine);
    layers.push_back({untouched_pieces(membrane.law, std::min(cosine, Scalar(1))), surface});
    const auto& pieces = layers.back().pieces;
    for (std::size_t i = 0; i != pieces.last(); ++i)
      if (const auto at = static_cast<double>(pieces.end(i)); std::isfinite(at)) depths.push_back(surface + at);
  }
  std::sort(depths.begin(), depths.end());

  double largest = 0;
  for (const bool inwards : {true, false}) {
    struct Sum {
      double value = 0, slope = 0;  // N, N/m
    };
    // The sum of all edges at a depth, with the pieces that hold at the depth `within`. So both sides of a break count.
    const auto sum = [&](double depth, double within) {
      Sum all;
      for (const Layer& layer : layers) {
        const auto& piece = layer.pieces.piece(layer.pieces.index(static_cast<Scalar>(within - layer.surface)));
        const auto& edge = inwards ? piece.lower : piece.upper;
        const auto x = static_cast<Scalar>(depth - layer.surface) - piece.origin;
        all.value += static_cast<double>(inwards ? -edge.value(x) : edge.value(x));
        all.slope += static_cast<double>(inwards ? -edge.slope(x) : edge.slope(x));
      }
      return all;
    };
    for (std::size_t k = 0; k < depths.size(); ++k) {
      const double from = depths[k], to = k + 1 < depths.size() ? depths[k + 1] : from + 1;
      const double within = from + (to - from) / 2;
      const Sum begin = sum(from, within), end = sum(to, within);
      largest = std::max({largest, begin.value, end.value});
      if (begin.slope > 0 && end.slope < 0)  // the edges are quadratic: the sum turns once
        largest = std::max(largest, sum(from + (to - from) * (begin.slope / (begin.slope - end.slope)), within).value);
    }
  }
  return largest;
}
}  // namespace detail

/// The largest friction along a needle, N, of all membranes that hold it together, on its way in and on its way out.
///
/// The needle goes straight through all membranes, along the inward normal of the first. A membrane that such a needle
/// does not enter from the front is left out. For a law with memory, the membrane is untouched. Sideways, only the
/// coupling limits the force; this is not included.
template <typename L, typename C, typename Storage>
double largest_force(const InsertionOf<L, C, Storage>& insertion) {
  return detail::largest_force(insertion.proxies());
}
template <typename Scalar>
double largest_force(const BasicInsertion<Scalar>& insertion) {
  return insertion.visit(insertion.proxies(), [](const auto& proxies) { return detail::largest_force(proxies); });
}

/// The largest force of a model without bands, N: of a needle that goes straight in at 20 mm/s, and comes back. A way
/// of several metres takes a million ticks, and the needle is faster.
///
/// from: m, in front of the tissue. inwards: its direction, of length 1. way: m. period: T, s.
template <typename Insertion>
double largest_force(Insertion model, const Vector3d& from, const Vector3d& inwards, double way, double period) {
  using Vector = Vector3<typename Insertion::Scalar>;
  const auto axis = inwards.template cast<typename Insertion::Scalar>();
  const auto ticks = static_cast<std::ptrdiff_t>(std::ceil(std::min(way / (20e-3 * period), 5e5)));
  double largest = 0;
  for (std::ptrdiff_t k = -ticks; k <= ticks; ++k) {
    const double at = way * (1 - std::abs(static_cast<double>(k) / static_cast<double>(ticks)));
    const Vector p = Vector3d(from + at * inwards).template cast<typename Insertion::Scalar>();
    const auto force = static_cast<double>(model.step(p, axis).norm());
    if (force > largest) largest = force;  // NaN is a fault of the run
  }
  return largest;
}

/// The force scale with which this force, N, can last on a device: then no limit cuts the friction.
///
/// It is at most 1, so it never makes a force larger.
inline double automatic_force_scale(double largest, const ForceLimits& limits) {
  const double lasting = automatic_share * lasting_force(limits);
  return largest > lasting ? lasting / largest : 1;
}

}  // namespace punctura
