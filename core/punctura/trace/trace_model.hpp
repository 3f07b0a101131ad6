// The force that the model gives along a measured motion, with its exact derivatives by all parameters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "punctura/model/needle.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/proxy/exact.hpp"
#include "punctura/trace/dual.hpp"

namespace punctura {

/// The parameters of one membrane of a trace, in this order.
inline constexpr std::array<std::string_view, 11> trace_membrane_names{
    "surface", "stiffness",   "precompression", "friction", "thickness", "tip_length",
    "growth",  "tail_length", "tail_floor",     "cutting",  "set"};
/// The parameters of the coupling, which all membranes of a trace share, in this order.
inline constexpr std::array<std::string_view, 6> trace_coupling_names{"coupling_stiffness",     "coupling_damping",
                                                                      "relaxation_1_stiffness", "relaxation_1_time",
                                                                      "relaxation_2_stiffness", "relaxation_2_time"};

using TraceMembrane = std::array<double, trace_membrane_names.size()>;  ///< SI; surface is the depth of contact, m
using TraceCoupling = std::array<double, trace_coupling_names.size()>;  ///< SI

/// The measured motion of a needle along its own direction.
struct TraceMotion {
  Needle needle;
  std::span<const double> depth;  ///< of the tip, m
  std::span<const double> time;   ///< s, ascending; empty: nothing depends on time
};

/// The number of derivatives of a sample: by the parameters of the coupling, then by those of each membrane.
constexpr std::size_t trace_parameters(std::size_t membranes) noexcept {
  return trace_coupling_names.size() + membranes * trace_membrane_names.size();
}

/// The additions to K06's membrane. A growth of 0 is a linear grip.
template <typename Scalar>
BasicTissue<Scalar> tissue_of(const std::array<Scalar, trace_membrane_names.size()>& p) {
  BasicTissue<Scalar> tissue;
  tissue.grip = p[6] == 0 ? GripShape::linear : GripShape::exponential;
  tissue.tip_length = p[5];
  tissue.growth = p[6];
  tissue.tail_length = p[7];
  tissue.tail_floor = p[8];
  tissue.cutting = p[9];
  tissue.set = p[10];
  return tissue;
}

/// Every parameter that is out of its range: "membrane[1].friction", "coupling.stiffness".
inline std::vector<Problem> problems_of_trace(const Needle& needle, std::span<const TraceMembrane> membranes,
                                              const TraceCoupling& coupling) {
  std::vector<Problem> problems;
  check(needle, "needle", problems);
  constexpr Range any{}, positive{0, no_bound, true, true, "must be greater than 0"},
      not_negative{0, no_bound, false, true, "must be 0 or more"};
  const auto check_one = [&](const Range& range, std::string_view name, double value, const std::string& path) {
    check_field({name, "", "", range}, value, path, problems);
  };
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const std::string path = "membrane[" + std::to_string(m) + "]";
    const TraceMembrane& p = membranes[m];
    check_one(any, trace_membrane_names[0], p[0], path);
    const Membrane membrane{p[1], p[2], p[3], p[4]};
    if (check(membrane, path, problems)) check_insertion(needle, membrane, path, problems);
    const Tissue tissue = tissue_of(p);
    if (check(tissue, path, problems)) check_curve(needle, membrane, tissue, path, problems);
  }
  for (std::size_t i = 0; i < coupling.size(); ++i)
    check_one(i == 0 || i == 3 || i == 5 ? positive : not_negative, trace_coupling_names[i], coupling[i], "");
  return problems;
}

namespace detail {

constexpr std::size_t coupling_seeds = trace_coupling_names.size(), membrane_seeds = trace_membrane_names.size();
using TraceDual = Dual<coupling_seeds + membrane_seeds>;  ///< derivatives: the coupling, then one membrane
using DualMembrane = std::array<TraceDual, membrane_seeds>;
using DualCoupling = std::array<TraceDual, coupling_seeds>;

/// K06's coupling (21) for one time step dt, s.
struct SpringAndDamper {
  using Type = SampledCoupling<TraceDual>;
  static Type of(const DualCoupling& c, double dt) noexcept { return {{c[0], c[1]}, dt}; }
};

/// Steps the exact solver in one membrane along a motion, and adds the force that resists insertion, with its
/// derivatives, to a row of `jacobian` for each sample.
template <typename C, typename L>
void add_membrane(const TraceMotion& motion, const L& law, const DualCoupling& coupling, const TraceDual& surface,
                  std::size_t first_column, std::span<double> force, std::span<double> jacobian) {
  const std::size_t n = motion.depth.size(), columns = jacobian.empty() ? 0 : jacobian.size() / n;
  const auto step_of = [&](std::size_t k) {
    return motion.time.empty() || n < 2 ? 1.0
           : k == 0                     ? motion.time[1] - motion.time[0]
                                        : motion.time[k] - motion.time[k - 1];
  };
  double dt = step_of(0);
  LineParams<L, typename C::Type> params{law, C::of(coupling, dt)};
  const auto memory = std::make_unique<LineState<L, typename C::Type>>();
  auto& state = *memory;
  for (std::size_t k = 0; k < n; ++k) {
    if (!state.started && motion.depth[k] < surface.value) continue;  // no membrane has been touched
    if (const double now = step_of(k); std::abs(now - dt) > 1e-9 * dt) params.coupling = C::of(coupling, dt = now);
    const TraceDual f = Exact::step(params, state, motion.depth[k] - surface).force;
    force[k] -= f.value;
    if (columns == 0) continue;
    double* row = &jacobian[k * columns];
    for (std::size_t i = 0; i < coupling_seeds; ++i) row[i] -= f.d[i];
    for (std::size_t i = 0; i < membrane_seeds; ++i) row[first_column + i] -= f.d[coupling_seeds + i];
  }
}

}  // namespace detail

/// The force that resists insertion at each sample (n), N, as the exact solver gives it, and its derivatives.
///
/// jacobian: n rows of trace_parameters(m) numbers: by the coupling, then by each membrane; or empty. The tip begins
/// outside all membranes. All membranes share one coupling. The parameters must be inside the ranges of validity.hpp.
inline void trace_forces(const TraceMotion& motion, std::span<const TraceMembrane> membranes,
                         const TraceCoupling& coupling, std::span<double> force, std::span<double> jacobian) {
  using namespace detail;
  std::fill(force.begin(), force.end(), 0.0);
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  const BasicNeedle<TraceDual> needle{motion.needle.diameter, motion.needle.tip_angle};
  DualCoupling c;
  for (std::size_t i = 0; i < coupling_seeds; ++i) c[i] = TraceDual::parameter(coupling[i], i);
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    DualMembrane p;
    for (std::size_t i = 0; i < membrane_seeds; ++i) p[i] = TraceDual::parameter(membranes[m][i], coupling_seeds + i);
    const BasicMembrane<TraceDual> membrane{p[1], p[2], p[3], p[4]};
    const auto add = [&](const auto& law) {
      add_membrane<SpringAndDamper>(motion, law, c, p[0], trace_parameters(m), force, jacobian);
    };
    const BasicTissue<TraceDual> tissue = tissue_of(p);
    if (is_k06(tissue))
      add(BasicThickLaw<TraceDual>(needle, membrane));
    else
      add(*std::make_unique<BasicTissueLaw<TraceDual>>(needle, membrane, tissue));  // its pieces take 0.1 MB
  }
}

}  // namespace punctura
