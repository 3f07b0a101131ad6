// One dimension: hand-written K06 (33), and Proxy1d with both solvers, over the same ticks.
#pragma once

#include <memory>
#include <vector>

#include "fused_1d.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "timing.hpp"
#include "work.hpp"

namespace bench {

/// One membrane. The model is copied to the stack first, so that its state can stay in registers like the reference's.
/// Never inlined, so that the compiler knows no more about solver and parameters than in a servo loop.
template <typename Model, typename Scalar>
[[gnu::noinline]] void run_one(const Model& start, const std::vector<Scalar>& depth, std::vector<Scalar>& force) {
  Model model = start;
  const Scalar* const p = depth.data();
  Scalar* const f = force.data();
  const std::size_t n = depth.size();
  for (std::size_t k = 0; k < n; ++k) f[k] = model.step(p[k]);
}

/// The sum over several membranes, each with the depth of its surface.
template <typename Model, typename Scalar>
[[gnu::noinline]] void run_several(const std::vector<Model>& start, const std::vector<Scalar>& surface,
                                   const std::vector<Scalar>& depth, std::vector<Scalar>& force) {
  std::vector<Model> models = start;
  for (std::size_t k = 0; k < depth.size(); ++k) {
    Scalar sum = 0;
    for (std::size_t i = 0; i < models.size(); ++i) sum += models[i].step(depth[k] - surface[i]);
    force[k] = sum;
  }
}

template <typename Model, typename Scalar>
Contestant contestant_1d(const char* name, std::vector<Model> models, const std::vector<Scalar>& surface,
                         const std::vector<Scalar>& depth) {
  auto force = std::make_shared<std::vector<Scalar>>(depth.size());
  return {name,
          [=] {
            if (models.size() == 1)
              run_one(models[0], depth, *force);
            else
              run_several(models, surface, depth, *force);
          },
          [=] { return std::vector<double>(force->begin(), force->end()); }};
}

/// Depth along the normal.
template <typename Scalar>
std::vector<Contestant> contestants_1d(const punctura::Scene& scene, const Motion& motion) {
  using Law = punctura::BasicThickLaw<Scalar>;
  using Proxy = punctura::Proxy1d<Law>;
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const punctura::BasicNeedle<Scalar> needle{to(scene.needle.diameter), to(scene.needle.tip_angle)};
  const punctura::BasicCoupling<Scalar> coupling{to(scene.coupling.stiffness), to(scene.coupling.damping)};
  const Scalar T = to(1 / scene.servo.rate);

  std::vector<Scalar> depth, surface;
  for (const Point& p : motion.tip) depth.push_back(to(-p[1]));
  std::vector<Fused1d<Scalar>> fused;
  std::vector<Proxy> paper, exact;
  for (const auto& placed : scene.membranes) {
    const auto& m = placed.membrane;
    const Law law(needle, {to(m.stiffness), to(m.precompression), to(m.friction), to(m.thickness)});
    surface.push_back(to(-placed.point[1]));
    fused.emplace_back(FusedLaw<Scalar>(law.constants(), law.thickness(), 1), coupling, T);
    fused.back().start(depth.front() - surface.back());
    paper.emplace_back(law, coupling, T, punctura::Solver::paper);
    exact.emplace_back(law, coupling, T, punctura::Solver::exact);
  }
  return {contestant_1d("fused", fused, surface, depth), contestant_1d("paper", paper, surface, depth),
          contestant_1d("exact", exact, surface, depth)};
}

}  // namespace bench
