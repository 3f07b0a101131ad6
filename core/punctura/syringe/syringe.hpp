// A syringe: its parameters, and the resistance of a cannula.
#pragma once

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "punctura/model/validity.hpp"

namespace punctura {

/// A syringe with liquid, air, or both. The plunger starts where the contents are at the pressure of the atmosphere.
template <typename Scalar>
struct BasicSyringe {
  Scalar bore = Scalar(not_given);        ///< inner diameter of the barrel, m
  Scalar liquid = Scalar(not_given);      ///< V_w at the start, m^3
  Scalar air{};                           ///< V_a at the start, at the pressure of the atmosphere, m^3
  Scalar friction = Scalar(not_given);    ///< F, dry friction of the plunger, N
  Scalar compliance = Scalar(not_given);  ///< C: by how much the pressure widens barrel and seal, m^3/Pa
  Scalar resistance = Scalar(not_given);  ///< R_c, flow resistance of the cannula for the liquid, Pa s/m^3

  /// Area of the plunger, m^2.
  constexpr Scalar area() const noexcept { return std::numbers::pi_v<Scalar> / 4 * bore * bore; }
};

using Syringe = BasicSyringe<double>;

/// What the opening of the needle leads to: a pressure behind a flow resistance.
///
/// What flows back into the syringe counts as liquid.
template <typename Scalar>
struct BasicOutlet {
  Scalar resistance = Scalar(not_given);  ///< R_t for the liquid, Pa s/m^3; 0 in open air
  Scalar pressure{};                      ///< P_t above that of the atmosphere, Pa
};

using Outlet = BasicOutlet<double>;

inline constexpr double atmosphere = 101325;          ///< P_0, Pa: the standard atmosphere
inline constexpr double liquid_viscosity = 1.002e-3;  ///< of water at 20 C, Pa s
/// How much more easily air flows than the liquid: the ratio of their viscosities at 20 C, 1.002e-3 / 1.81e-5.
inline constexpr double air_flows_easier = 55.4;

/// Flow resistance of a tube for the liquid, Pa s/m^3: 128 mu L / (pi d^4), by Hagen and Poiseuille.
///
/// bore: inner diameter d, m. length: L, m.
inline double tube_resistance(double bore, double length) noexcept {
  return 128 * liquid_viscosity * length / (std::numbers::pi * bore * bore * bore * bore);
}

// clang-format off
inline constexpr FieldOf<Syringe> syringe_fields[] = {
    {{"bore", "d", "m", greater_than_0,
      "Inner diameter of the barrel.", in_unit("mm"), {1e-3, 0.1}}, &Syringe::bore},
    {{"liquid", "V_w", "m^3", at_least_0,
      "Volume of liquid at the start.", in_unit("mL"), {1e-8, 3e-4}}, &Syringe::liquid},
    {{"air", "V_a", "m^3", at_least_0,
      "Volume of air at the start, at the pressure of the atmosphere.", in_unit("mL"), {1e-9, 3e-4}}, &Syringe::air},
    {{"friction", "F", "N", at_least_0,
      "Dry friction of the plunger.", in_unit("N"), {1e-3, 100}}, &Syringe::friction},
    {{"compliance", "C", "m^3/Pa",
      {0, no_bound, true, true, ": a rigid barrel has no single pressure"},
      "By how much pressure widens barrel and seal.", in_unit("mL_per_kPa"), {1e-15, 2e-10}}, &Syringe::compliance},
    {{"resistance", "R_c", "Pa s/m^3", greater_than_0,
      "Flow resistance of the cannula for the liquid.", in_unit("kPa_s_per_mL"), {1e7, 1e13}}, &Syringe::resistance},
};
// clang-format on

inline constexpr Range resistance_range = {0, no_bound, false, true, "", "open"};
inline constexpr Range pressure_range = {-atmosphere, no_bound, true, true, ": there is no lower pressure than none"};
inline constexpr FieldOf<Outlet> outlet_fields[] = {
    {{"resistance", "R_t", "Pa s/m^3", resistance_range, "For the liquid; 0 in open air."}, &Outlet::resistance},
    {{"pressure", "P_t", "Pa", pressure_range, "Above that of the atmosphere."}, &Outlet::pressure},
};

inline bool check(const Syringe& syringe, const std::string& path, std::vector<Problem>& problems) {
  const bool good = check_fields(syringe_fields, syringe, path, problems);
  if (!good || syringe.liquid + syringe.air > 0) return good;
  problems.push_back({path, 0, "liquid or air must be greater than 0: an empty syringe has no plunger to push"});
  return false;
}

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
  constexpr explicit Opening(Scalar length) noexcept : length_(length) {}

  /// The next layer to the back.
  constexpr void pass(const LayerAtTip<Scalar>& layer) noexcept {
    const Scalar entered = std::min(share(layer.depth), ahead_);
    const Scalar through = std::min(share(layer.depth - layer.path_length), entered);
    add(ahead_ - entered, here_);
    add(entered - through, layer.inside);
    here_ = layer.behind;
    ahead_ = through;
  }

  /// The outlet of all layers that were passed.
  constexpr BasicOutlet<Scalar> outlet() const noexcept {
    Opening all = *this;
    all.add(ahead_, here_);
    return {1 / all.conductance_, all.weighted_ / all.conductance_};
  }

 private:
  /// In open air only the cannula limits the flow. A finite number keeps the sum finite: a thousandth of a cannula.
  static constexpr Scalar open = Scalar(1e6);  // Pa s/m^3

  constexpr Scalar share(Scalar depth) const noexcept { return std::clamp(depth / length_, Scalar(0), Scalar(1)); }
  constexpr void add(Scalar share, const BasicOutlet<Scalar>& outlet) noexcept {
    const Scalar conducts = share / std::max(outlet.resistance, open);
    conductance_ += conducts;
    weighted_ += conducts * outlet.pressure;
  }

  Scalar length_, conductance_ = 0, weighted_ = 0;
  Scalar ahead_ = 1;                ///< the share of the opening behind the layers so far
  BasicOutlet<Scalar> here_{0, 0};  ///< the outlet of that share; in front of all layers open air
};

template <typename Scalar>
constexpr BasicOutlet<Scalar> outlet_at(std::span<const LayerAtTip<Scalar>> layers, Scalar length) noexcept {
  Opening<Scalar> opening(length);
  for (const auto& layer : layers) opening.pass(layer);
  return opening.outlet();
}

}  // namespace punctura
