// A wall of measured tissue against K06's membrane, with the same solver over the same ticks.
#pragma once

#include <memory>
#include <vector>

#include "contest_1d.hpp"
#include "contest_3d.hpp"
#include "punctura/model/tissue_law.hpp"

namespace bench {

/// A profile of 8 knots that rises, flattens and falls, with cutting and a set.
inline punctura::Tissue measured_tissue() {
  punctura::Tissue tissue;
  tissue.cutting = 0.2;
  tissue.set = 0.1;
  tissue.profile = {{0, -0.05, 0.01},    {0.7e-3, -0.3, 0.05},  {1.4e-3, -0.5, 0.1},  {2.1e-3, -0.62, 0.15},
                    {2.8e-3, -0.7, 0.2}, {3.7e-3, -0.55, 0.42}, {4.6e-3, -0.42, 0.4}, {5.5e-3, -0.35, 0.35}};
  return tissue;
}

/// One slow way in, from 0.5 mm in front of the wall to behind it: the tip cuts in nearly every tick.
inline Motion first_way() {
  Motion motion{"first way", {}, {}, {}};
  for (std::size_t k = 0; k < ticks; ++k) {
    const double depth = -0.5e-3 + 7e-3 * static_cast<double>(k) / static_cast<double>(ticks);
    motion.tip.push_back({0, -depth, 0});
    motion.axis.push_back({0, -1, 0});
  }
  return motion;
}

/// K06 and then the tissue, one membrane, along the normal.
inline std::vector<Contestant> tissue_1d(const punctura::Scene& scene, const Motion& motion, punctura::Solver solver) {
  std::vector<double> depth;
  for (const Point& p : motion.tip) depth.push_back(-p[1]);
  const punctura::Membrane& m = scene.membranes[0].membrane;
  const punctura::ThickLaw k06(scene.needle, m);
  const punctura::TissueLaw tissue(scene.needle, m, measured_tissue());
  const double T = 1 / scene.servo.rate;
  const std::vector<punctura::Proxy1d<punctura::ThickLaw>> plain{{k06, scene.coupling, T, solver}};
  const std::vector<punctura::Proxy1d<punctura::TissueLaw>> measured{{tissue, scene.coupling, T, solver}};
  return {contestant_1d("K06", plain, {0.0}, depth), contestant_1d("tissue", measured, {0.0}, depth)};
}

/// The same in space, as an Insertion without low-pass.
inline std::vector<Contestant> tissue_3d(punctura::Scene scene, const Motion& motion, punctura::Solver solver) {
  scene.servo.solver = solver;
  const auto tip = to_vectors<punctura::Vector3d>(motion.tip), axis = to_vectors<punctura::Vector3d>(motion.axis);
  const auto measured = punctura::build_insertion<double>(
      scene, [](const punctura::Needle& needle, const punctura::Membrane& membrane, std::size_t) {
        return punctura::TissueLaw(needle, membrane, measured_tissue());
      });
  return {contestant_3d("K06", punctura::build_insertion<double>(scene), tip, axis),
          contestant_3d("tissue", measured, tip, axis)};
}

}  // namespace bench
