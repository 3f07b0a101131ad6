// Everything a run needs, as plain structs in SI units.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "punctura/insertion/insertion.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/needle.hpp"
#include "punctura/model/omni.hpp"
#include "punctura/proxy/coupling.hpp"
#include "punctura/proxy/solver.hpp"
#include "punctura/signal/conditioning.hpp"

namespace punctura {

/// What is between a membrane and the next one in the way. No force depends on it.
enum class Behind : std::uint8_t { tissue, blood };

struct PlacedMembrane {
  std::string name;
  Membrane membrane{};                    ///< has no default: check() names what is missing
  std::array<double, 3> point{};          ///< any point of the surface, m
  std::array<double, 3> inward_normal{};  ///< a direction of any length but 0
  Behind behind = Behind::tissue;
};

struct ServoSettings {
  double rate = usual_rate;  ///< 1/T, Hz
  double low_pass = 300;     ///< cutoff, Hz, for Conditioning::low_pass; 0 is off. K06 section 4
  Solver solver = Solver::exact;
  Conditioning conditioning = Conditioning::low_pass;
  double encoder_step = Omni::encoder_step;  ///< m, for line_fit; 0 is an ideal sensor
};

struct Scene {
  std::string name;
  Needle needle{};      ///< has no default: all 0 is a problem that check() names
  Coupling coupling{};  ///< likewise
  std::vector<PlacedMembrane> membranes;
  ServoSettings servo{};
  Direction direction = Direction::stylus;
};

}  // namespace punctura
