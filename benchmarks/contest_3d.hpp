// In space: hand-written K06 (41), Insertion with both solvers, and the whole servo step.
#pragma once

#include <memory>
#include <vector>

#include "fused_3d.hpp"
#include "punctura/scene/build.hpp"
#include "timing.hpp"
#include "work.hpp"

namespace bench {

template <typename Vector>
std::vector<Vector> to_vectors(const std::vector<Point>& points) {
  using Scalar = std::decay_t<decltype(Vector{}[0])>;
  std::vector<Vector> out;
  for (const Point& p : points)
    out.push_back({static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2])});
  return out;
}

template <typename Vector>
std::vector<double> flat(const std::vector<Vector>& vectors) {
  std::vector<double> out;
  for (const Vector& v : vectors)
    for (const auto x : {v[0], v[1], v[2]}) out.push_back(static_cast<double>(x));
  return out;
}

/// Never inlined, as in contest_1d.hpp. The state is in memory, as in a servo loop.
template <typename Model, typename Vector>
[[gnu::noinline]] void run_in_space(Model& model, const std::vector<Vector>& tip, const std::vector<Vector>& axis,
                                    std::vector<Vector>& force) {
  for (std::size_t k = 0; k < tip.size(); ++k) force[k] = model.step(tip[k], axis[k]);
}

template <typename Model, typename Vector>
Contestant contestant_3d(const char* name, const Model& start, const std::vector<Vector>& tip,
                         const std::vector<Vector>& axis) {
  auto force = std::make_shared<std::vector<Vector>>(tip.size());
  auto model = std::make_shared<Model>(start);
  return {name,
          [=] {
            model->reset();
            run_in_space(*model, tip, axis, *force);
          },
          [=] { return flat(*force); }};
}

/// Without low-pass, because the tip is already filtered.
template <typename Scalar>
std::vector<Contestant> contestants_3d(const punctura::Scene& scene, const Motion& motion) {
  using Vector = punctura::Vector3<Scalar>;
  const auto with = [&](punctura::Solver solver) {
    punctura::Scene s = scene;
    s.servo.solver = solver;
    s.servo.low_pass = 0;
    return punctura::build_insertion<Scalar>(s);
  };
  return {contestant_3d("fused", FusedInsertion<Scalar>(scene), to_vectors<Vec<Scalar>>(motion.tip),
                        to_vectors<Vec<Scalar>>(motion.axis)),
          contestant_3d("paper", with(punctura::Solver::paper), to_vectors<Vector>(motion.tip),
                        to_vectors<Vector>(motion.axis)),
          contestant_3d("exact", with(punctura::Solver::exact), to_vectors<Vector>(motion.tip),
                        to_vectors<Vector>(motion.axis))};
}

[[gnu::noinline]] inline void run_servo(punctura::ServoStep& servo, const std::vector<punctura::DeviceSample>& samples,
                                        std::vector<Point>& force) {
  for (std::size_t k = 0; k < samples.size(); ++k) force[k] = servo.step(samples[k]).model_force;
}

/// The whole tick: input gate, low-pass, proxies, limits, snapshot. It has no reference loop.
inline std::vector<Contestant> contestants_servo(const punctura::Scene& scene, const Motion& motion) {
  std::vector<punctura::DeviceSample> samples;
  for (std::size_t k = 0; k < motion.measured.size(); ++k)
    samples.push_back({k, static_cast<double>(k) / rate, motion.measured[k], motion.axis[k], 0, true});

  std::vector<Contestant> contestants;
  for (const auto solver : {punctura::Solver::paper, punctura::Solver::exact}) {
    punctura::Scene s = scene;
    s.servo.solver = solver;
    s.servo.low_pass = low_pass_hz;
    auto servo = std::make_shared<punctura::ServoStep>(punctura::build(s));
    auto force = std::make_shared<std::vector<Point>>(samples.size());
    contestants.push_back({solver == punctura::Solver::paper ? "paper" : "exact",
                           [=] {
                             servo->reset();
                             servo->arm();
                             run_servo(*servo, samples, *force);
                           },
                           [=] { return flat(*force); }});
  }
  return contestants;
}

/// The share of ticks that the proxies spent in each phase.
struct Shares {
  double outside = 0, sticking = 0, sliding_in = 0, sliding_out = 0, barred = 0;
};

inline Shares shares(punctura::Scene scene, const Motion& motion) {
  scene.servo.low_pass = 0;
  scene.servo.solver = punctura::Solver::exact;
  auto insertion = punctura::build_insertion<double>(scene);
  Shares share;
  const double one = 1 / static_cast<double>(motion.tip.size() * scene.membranes.size());
  for (std::size_t k = 0; k < motion.tip.size(); ++k) {
    insertion.step(punctura::to_vector(motion.tip[k]), punctura::to_vector(motion.axis[k]));
    for (const auto& proxy : *insertion.k06()) switch (proxy.phase()) {
        case punctura::Phase::outside: share.outside += one; break;
        case punctura::Phase::sticking: share.sticking += one; break;
        case punctura::Phase::sliding_in: share.sliding_in += one; break;
        case punctura::Phase::sliding_out: share.sliding_out += one; break;
        case punctura::Phase::barred: share.barred += one; break;
      }
  }
  return share;
}

}  // namespace bench
