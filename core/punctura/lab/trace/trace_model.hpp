// The force that the model gives along a measured motion, with its exact derivatives by all parameters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "punctura/lab/trace/dual.hpp"
#include "punctura/lab/trace/jump.hpp"
#include "punctura/model/membrane.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/relaxing_coupling.hpp"
#include "punctura/scene/fields.hpp"

namespace punctura {

namespace detail {

constexpr auto fields_of_a_membrane() {
  std::array<Field, 1 + std::size(membrane_fields) + tissue_fields.size()> fields{{{"surface", "", "m"}}};
  std::copy(tissue_fields.begin(), tissue_fields.end(),
            std::copy(std::begin(membrane_fields), std::end(membrane_fields), fields.begin() + 1));
  return fields;
}
constexpr Field field_as(std::string_view name, Field field) {
  field.name = name;
  return field;
}

}  // namespace detail

/// The parameters of one membrane of a trace, in this order: the depth of contact, then the numbers of Membrane and
/// Tissue.
inline constexpr auto trace_membrane_fields = detail::fields_of_a_membrane();
/// The parameters of the coupling, which all membranes of a trace share, in this order.
inline constexpr std::array<Field, 6> trace_coupling_fields{
    detail::field_as("coupling_stiffness", field_of(coupling_fields, &Coupling::stiffness)),
    detail::field_as("coupling_damping", field_of(coupling_fields, &Coupling::damping)),
    detail::field_as("relaxation_1_stiffness", field_of(branch_fields, &MaxwellBranch::stiffness)),
    detail::field_as("relaxation_1_time", field_of(branch_fields, &MaxwellBranch::time_constant)),
    detail::field_as("relaxation_2_stiffness", field_of(branch_fields, &MaxwellBranch::stiffness)),
    detail::field_as("relaxation_2_time", field_of(branch_fields, &MaxwellBranch::time_constant))};

using TraceMembrane = std::array<double, trace_membrane_fields.size()>;  ///< SI
using TraceCoupling = std::array<double, trace_coupling_fields.size()>;  ///< SI

/// The measured motion of a needle along its own direction.
struct TraceMotion {
  Needle needle;
  std::span<const double> depth;  ///< of the tip, m
  std::span<const double> time;   ///< s, ascending; empty: nothing depends on time
};

/// The number of derivatives of a sample: by the parameters of the coupling, then by those of each membrane.
constexpr std::size_t trace_parameters(std::size_t membranes) noexcept {
  return trace_coupling_fields.size() + membranes * trace_membrane_fields.size();
}

/// The additions to K06's membrane. A growth of 0 is a linear grip.
template <typename Scalar>
BasicTissue<Scalar> tissue_of(const std::array<Scalar, trace_membrane_fields.size()>& p) {
  BasicTissue<Scalar> tissue;
  auto from = p.end() - tissue_fields.size();
  for (const auto& number : numbers_of<Scalar>(tissue_rows_of<Scalar>)) tissue.*number.member = *from++;
  tissue.grip = tissue.growth == 0 ? GripShape::linear : GripShape::exponential;
  return tissue;
}

/// Every parameter that is out of its range: "membrane[1].friction", "coupling.stiffness".
inline std::vector<Problem> problems_of_trace(const Needle& needle, std::span<const TraceMembrane> membranes,
                                              const TraceCoupling& coupling) {
  std::vector<Problem> problems;
  check(needle, "needle", problems);
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const std::string path = "membrane[" + std::to_string(m) + "]";
    const TraceMembrane& p = membranes[m];
    check_field(trace_membrane_fields[0], p[0], path, problems);
    const Membrane membrane{p[1], p[2], p[3], p[4]};
    if (check(membrane, path, problems)) check_insertion(needle, membrane, path, problems);
    const Tissue tissue = tissue_of(p);
    check(tissue, path, problems);  // a search may pass curves that chords follow badly: no check_curve()
  }
  for (std::size_t i = 0; i < coupling.size(); ++i) check_field(trace_coupling_fields[i], coupling[i], "", problems);
  return problems;
}

namespace detail {

constexpr std::size_t coupling_seeds = trace_coupling_fields.size(), membrane_seeds = trace_membrane_fields.size();
using TraceDual = Dual<coupling_seeds + membrane_seeds>;  ///< derivatives: the coupling, then one membrane

/// Which derivative of a dual number is that by a parameter (the coupling's, then a membrane's); `none`: it has none.
struct TraceSeeds {
  static constexpr std::uint8_t none = 255;
  std::array<std::uint8_t, coupling_seeds + membrane_seeds> slot;
  std::size_t count = 0;

  /// wanted: a flag for each parameter; empty: all.
  explicit constexpr TraceSeeds(std::span<const bool> wanted = {}) noexcept {
    for (std::size_t i = 0; i < slot.size(); ++i)
      slot[i] = wanted.empty() || wanted[i] ? static_cast<std::uint8_t>(count++) : none;
  }
};

/// Copies what jump_of() reads of a state, without the pieces.
template <typename State>
void copy_for_jump(State& to, const State& from) noexcept {
  to.p = from.p;
  to.e = from.e;
  to.law = from.law;
  to.coupling = from.coupling;
}

/// K06's coupling (21) for one time step dt, s.
template <typename Scalar>
struct SpringAndDamper {
  using Type = SampledCoupling<Scalar>;
  static Type of(const std::array<Scalar, coupling_seeds>& c, double dt) noexcept { return {{c[0], c[1]}, dt}; }
};

/// The same with Maxwell branches beside it.
template <typename Scalar>
struct Relaxing {
  using Type = RelaxingCoupling<Scalar>;
  static Type of(const std::array<Scalar, coupling_seeds>& c, double dt) noexcept {
    const std::array<BasicMaxwellBranch<Scalar>, max_branches> branches{{{c[2], c[3]}, {c[4], c[5]}}};
    return {{c[0], c[1]}, branches, dt};
  }
};

/// The rows of a result: forces, and derivatives if they are wanted.
struct TraceRows {
  std::span<double> force, jacobian;
  std::size_t columns, first_column;  // first_column: of this membrane
  TraceSeeds seeds;

  void add(std::size_t k, double f) const noexcept { force[k] += f; }
  template <std::size_t N>
  void add(std::size_t k, const Dual<N>& f) const noexcept {
    force[k] += f.value;
    double* row = &jacobian[k * columns];
    for (std::size_t i = 0; i < seeds.slot.size(); ++i) {
      const std::size_t column = i < coupling_seeds ? i : first_column + i - coupling_seeds;
      if (seeds.slot[i] < N) row[column] += f.d[seeds.slot[i]];
    }
  }
};

/// The jump of the proxy in its last tick. before: the state in front of this tick; p: the device's depth, m.
template <typename L, typename C, typename Scalar>
Jump<Scalar> jump_of(const LineParams<L, C>& params, const LineState<L, C>& before, const LineTick<Scalar>& tick,
                     const Scalar& p) noexcept {
  const Scalar f_star = params.coupling.holding_force(p, before.p, before.e, before.coupling);
  const SlidingTick<Scalar> sliding{p - before.p, before.p + before.e, tick.proxy, f_star, params.coupling.g};
  const auto find = [&](const auto& pieces) {
    return tick.phase == Phase::sliding_in ? find_jump<+1>(pieces, sliding) : find_jump<-1>(pieces, sliding);
  };
  if constexpr (LawWithMemory<L>)
    return find(before.pieces);
  else
    return find(params.law.pieces());
}

/// Steps the exact solver in one membrane along a motion and adds the force that resists insertion to the rows.
///
/// A sample stands for the way from half a step before to half a step behind it. If the force jumps on this way, the
/// sample gets the average. So the force is a continuous function of the parameters, and its derivatives contain the
/// place of the jump.
template <typename C, typename Scalar, typename L>
void add_membrane(const TraceMotion& motion, const L& law, const std::array<Scalar, coupling_seeds>& coupling,
                  const Scalar& surface, const TraceRows& rows) {
  const std::size_t n = motion.depth.size();
  const auto step_of = [&](std::size_t k) {
    if (motion.time.empty() || n < 2) return 1.0;
    return k == 0 ? motion.time[1] - motion.time[0] : motion.time[k] - motion.time[k - 1];
  };
  double dt = step_of(0);
  LineParams<L, typename C::Type> params{law, C::of(coupling, dt)};
  using State = LineState<L, typename C::Type>;
  const auto states = std::make_unique<std::array<State, 2>>();  // of a law with memory: 0.1 MB each
  State &state = (*states)[0], &before = (*states)[1];
  if constexpr (LawWithMemory<L>) before.pieces = params.law.pieces();
  for (std::size_t k = 0; k < n; ++k) {
    const Scalar p = motion.depth[k] - surface;
    if (!state.started && p < 0 && k + 1 < n && motion.depth[k + 1] < surface) continue;  // not touched yet
    if (const double now = step_of(k); std::abs(now - dt) > 1e-9 * dt) params.coupling = C::of(coupling, dt = now);
    const bool may_jump = state.started && p != state.p;
    if (may_jump) copy_for_jump(before, state);
    const auto tick = Exact::step(params, state, p);
    rows.add(k, -tick.force);
    if (!may_jump || tick.phase == Phase::sticking) continue;
    const Scalar way = tick.proxy - (before.p + before.e), moved = p - before.p;
    if (way * way < 1.2 * moved * moved) continue;
    if constexpr (LawWithMemory<L>) params.law.refresh(before.pieces, before.law);
    const Jump<Scalar> jump = jump_of(params, before, tick, p);
    if (!jump.found || !(jump.share > 0 && jump.share < 1)) continue;
    if (jump.share < 0.5)
      rows.add(k - 1, -(0.5 - jump.share) * jump.drop);
    else
      rows.add(k, (jump.share - 0.5) * jump.drop);
  }
}

inline constexpr std::size_t trace_chords = 12;  ///< of a grip: a fixed number, so that no derivative jumps

/// Calls use(law) with the law of a membrane.
template <typename Scalar, typename Use>
void with_law(const BasicNeedle<Scalar>& needle, const std::array<Scalar, membrane_seeds>& p, Use&& use) {
  const BasicMembrane<Scalar> membrane{p[1], p[2], p[3], p[4]};
  const BasicTissue<Scalar> tissue = tissue_of(p);
  if (is_k06(tissue))
    use(BasicThickLaw<Scalar>(needle, membrane));
  else
    use(*std::make_unique<BasicTissueLaw<Scalar>>(needle, membrane, tissue, Scalar(1), trace_chords));  // 0.1 MB
}

/// The parameters as dual numbers, each with its own derivative if it is wanted, or as they are.
template <typename Scalar, std::size_t N>
std::array<Scalar, N> seeded(const std::array<double, N>& values, [[maybe_unused]] std::size_t first,
                             [[maybe_unused]] const TraceSeeds& seeds = TraceSeeds{}) noexcept {
  std::array<Scalar, N> made;
  for (std::size_t i = 0; i < N; ++i) {
    made[i] = values[i];
    if constexpr (!std::is_same_v<Scalar, double>)
      if (const auto slot = seeds.slot[first + i]; slot != TraceSeeds::none) made[i].d[slot] = 1;
  }
  return made;
}

/// The depth of the tip behind the surface at which a slow needle pops, m: where the proxy jumps, or, with a stiff
/// coupling, where the force falls fastest.
template <typename L>
typename L::Scalar pop_depth(const L& law, const typename L::Scalar& stiffness) noexcept {
  using Scalar = typename L::Scalar;
  const auto& pieces = law.pieces();
  Scalar at(0), before(0), steepest(-1e300);
  for (std::size_t i = pieces.index(Scalar(0)); i != pieces.last(); ++i) {
    const auto& piece = pieces.piece(i);
    for (const Scalar& q : {Scalar(pieces.end(i - 1)), Scalar(pieces.end(i))}) {
      const Scalar slope = piece.lower.slope(q - piece.origin);
      if (!(slope > steepest)) continue;
      steepest = slope;
      at = q;
      before = piece.lower.value(q - piece.origin);
    }
  }
  Scalar jump_at, jump_before;
  const Scalar end = pieces.end(pieces.last() - 1);
  if (jump_depth<+1>(pieces, SlidingTick<Scalar>{end, Scalar(0), end, Scalar(0), stiffness}, jump_at, jump_before))
    return jump_at - jump_before / stiffness;
  return at - before / stiffness;
}

/// Computes all membranes with Scalar, a double or a dual number.
template <typename Scalar>
void add_membranes(const TraceMotion& motion, std::span<const TraceMembrane> membranes, const TraceCoupling& coupling,
                   TraceRows rows) {
  const BasicNeedle<Scalar> needle{motion.needle.diameter, motion.needle.tip_angle};
  const auto c = seeded<Scalar>(coupling, 0, rows.seeds);
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const auto p = seeded<Scalar>(membranes[m], coupling_seeds, rows.seeds);
    rows.first_column = trace_parameters(m);
    const auto add = [&](const auto& law) {
      if (coupling[2] > 0 || coupling[4] > 0)
        add_membrane<Relaxing<Scalar>>(motion, law, c, p[0], rows);
      else
        add_membrane<SpringAndDamper<Scalar>>(motion, law, c, p[0], rows);
    };
    with_law(needle, p, add);
  }
}

}  // namespace detail

/// The depth of the tip behind the surface at which a slow needle pops, m; a dual number has its derivatives, too: by
/// the coupling, then by the membrane.
template <typename Scalar = detail::TraceDual>
Scalar trace_pop(const Needle& needle, const TraceMembrane& membrane, const TraceCoupling& coupling) {
  using namespace detail;
  const auto c = seeded<Scalar>(coupling, 0);
  const Scalar spring = c[0] + c[2] + c[4];  // the branches relax little on the way to a pop
  Scalar depth;
  with_law(BasicNeedle<Scalar>{needle.diameter, needle.tip_angle}, seeded<Scalar>(membrane, coupling_seeds),
           [&](const auto& law) { depth = pop_depth(law, spring); });
  return depth;
}

/// The force that resists insertion at each sample (n), N, as the exact solver gives it, and its derivatives.
///
/// jacobian: n rows of trace_parameters(m) numbers: by the coupling, then by each membrane; or empty. wanted: which
/// derivatives, a flag for each parameter of the coupling, then for each of a membrane (empty: all); the others are 0.
/// The tip begins outside all membranes. All membranes share one coupling. The parameters must have passed
/// problems_of_trace().
inline void trace_forces(const TraceMotion& motion, std::span<const TraceMembrane> membranes,
                         const TraceCoupling& coupling, std::span<double> force, std::span<double> jacobian,
                         std::span<const bool> wanted = {}) {
  std::fill(force.begin(), force.end(), 0.0);
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  const detail::TraceSeeds seeds{wanted};
  const detail::TraceRows rows{force, jacobian, trace_parameters(membranes.size()), 0, seeds};
  if (jacobian.empty())
    detail::add_membranes<double>(motion, membranes, coupling, rows);
  else if (seeds.count <= 6)  // K06 itself: a dual number costs as much as it has derivatives
    detail::add_membranes<Dual<6>>(motion, membranes, coupling, rows);
  else if (seeds.count <= 10)
    detail::add_membranes<Dual<10>>(motion, membranes, coupling, rows);
  else
    detail::add_membranes<detail::TraceDual>(motion, membranes, coupling, rows);
}

}  // namespace punctura
