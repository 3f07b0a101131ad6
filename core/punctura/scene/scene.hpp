// A scene: the description of a run, as plain structs in SI units.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/insertion/insertion.hpp"
#include "punctura/model/field.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/omni.hpp"
#include "punctura/model/tissue.hpp"
#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/relaxing_coupling.hpp"
#include "punctura/proxy/solver.hpp"
#include "punctura/signal/conditioning.hpp"
#include "punctura/syringe/syringe.hpp"

namespace punctura {

/// The drawn kind of a membrane. `plain` is a sheet of glass.
enum class Look : std::uint8_t {
  plain,
  skin,
  fat,
  muscle,
  fascia,
  ligament,
  ligamentum_flavum,
  dura,
  vein_wall,
  artery_wall,
};

/// The content of the space behind a membrane, up to the next membrane. Only `blood` has a meaning beyond the
/// picture: it bounds the lumen (lumen.hpp).
enum class Behind : std::uint8_t { tissue, blood, fat, muscle, epidural_space, cerebrospinal_fluid };

template <>
inline constexpr std::array<std::string_view, 10> words_of<Look>{
    "plain", "skin", "fat", "muscle", "fascia", "ligament", "ligamentum flavum", "dura", "vein wall", "artery wall"};
template <>
inline constexpr std::array<std::string_view, 6> words_of<Behind>{"tissue", "blood",          "fat",
                                                                  "muscle", "epidural space", "cerebrospinal fluid"};

/// The outlet of tissue that takes no liquid: 1 mL leaves in a day at 10 kPa. Illustrative.
inline constexpr Outlet dense_tissue{1e15, 0};

/// A membrane at its place in the scene, with what is drawn and what liquid meets there.
struct PlacedMembrane {
  std::string name;
  Membrane membrane{};
  std::array<double, 3> point{not_given, not_given, not_given};          ///< any point of the surface, m
  std::array<double, 3> inward_normal{not_given, not_given, not_given};  ///< a direction of any length except 0
  Behind behind = Behind::tissue;        ///< for the picture and for lumen(); no force depends on it
  Look look = Look::plain;               ///< for the picture
  Outlet outflow = dense_tissue;         ///< what liquid from the needle meets in the membrane
  Outlet outflow_behind = dense_tissue;  ///< the same for the space behind it
  Tissue tissue{};                       ///< what measured tissue adds to the membrane
};

/// The syringe on the needle, and the virtual coupling between thumb and plunger.
struct SyringeSettings {
  Syringe syringe{};
  Coupling thumb{2000, 2};
};

/// How a run computes: ticks, filter, solver.
struct ServoSettings {
  double rate = usual_rate;  ///< 1/T, Hz
  double low_pass = 300;     ///< cutoff for Conditioning::low_pass, Hz; 0 is off. K06 section 4
  Solver solver = Solver::exact;
  Conditioning conditioning = Conditioning::low_pass;
  double encoder_step = Omni::encoder_step;  ///< m, for line_fit; 0 is an ideal sensor
  double sub_steps = 1;  ///< steps of the model in a tick: a whole number, as a double like all numbers of a scene
};

/// How a device shows the forces of the model, if it cannot give them.
struct DisplaySettings {
  double force_scale = 1;  ///< how much of the model's force the device gives: greater than 0, at most 1
  bool automatic = false;  ///< replaces force_scale by automatic_force_scale(), for the limits in use
};

/// The description of a run: needle, coupling, membranes and settings, in SI units. Its numbers without a default are
/// not_given at first; check() reports them.
struct Scene {
  std::string name;
  Needle needle{};
  Coupling coupling{};
  std::vector<PlacedMembrane> membranes;
  ServoSettings servo{};
  Direction direction = Direction::stylus;
  DisplaySettings display{};
  std::optional<SyringeSettings> syringe{};  ///< empty: no syringe
  std::vector<MaxwellBranch> relaxation{};   ///< beside the coupling, at most max_branches; empty in K06
};

}  // namespace punctura
