// K06's numbers while the program is compiled: a tick needs nothing but arithmetic.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "../support/cut_law.hpp"
#include "punctura/insertion/insertion.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/proxy/relaxing_coupling.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"
#include "punctura/servo/servo_step.hpp"
#include "punctura/syringe/plunger.hpp"

// GCC 12 cannot move an array of vectors while it compiles ("deallocation of already deallocated storage").
#if __cpp_lib_constexpr_vector && (defined(__clang__) || __GNUC__ > 12)
#define PUNCTURA_WHOLE_TICKS
#endif

// Tests are compiled together; these short names are of this file.
namespace punctura::constant_test {
namespace {

constexpr Needle needle{1.08e-3, 0.28};
constexpr Membrane thin{570, 0.41, 0.2, 0}, thick{570, 0.41, 0.2, 1e-4};
constexpr Coupling coupling{400, 1};
constexpr double period = 1 / 1600.0;

constexpr bool near(double a, double b) { return a - b < 1e-13 && b - a < 1e-13; }

// Along the normal: the tip's largest force, and the friction of the shaft.
constexpr BasicThinLaw<double> thin_law(needle, thin);
constexpr BasicThickLaw<double> thick_law(needle, thick);
static_assert(near(thin_law.constants().F, 0.41024));
static_assert(near(thin_law.band(1).lower, -0.41024) && near(thin_law.band(1).upper, 0.41024));
static_assert(near(thin_law.band(thin_law.constants().X).lower, -0.73566799041232689));
static_assert(near(thick_law.band(thick_law.constants().X).lower, -0.7297894621175145));
static_assert(thin_law.band(-1e-9).lower == 0 && thick_law.band(0).upper == 0);

/// A wall that the needle cuts and in which a hole stays, and a coupling that relaxes.
constexpr TissueLaw tissue_law() {
  Tissue tissue;
  tissue.tip_length = 3e-3;
  tissue.cutting = 0.2;
  tissue.set = 0.5;
  return {needle, thick, tissue};
}
constexpr TissueLaw measured = tissue_law();
constexpr RelaxingCoupling<double> relaxing(
    {.K = 400, .g = 2300, .inv_g = 1 / 2300.0, .free_share = 0.8, .branches = {{{0.9, 300}}}, .count = 1});

/// Gate and limiter: what they let through of a stronger force, N.
constexpr double limited() {
  InputGate gate({}, period, true);
  ForceLimiter limiter({.max_force = 1, .ramp_time = period}, period);
  double force = 0;
  for (std::uint64_t k = 0; k < 4; ++k) {
    const DeviceSample sample{k, static_cast<double>(k) * period, {0, 1e-3, 0}, {0, -1, 0}, 0, true};
    force = gate.step(sample) == Fault::none ? limiter.step({0, 3, 4}).norm() : -1;
  }
  return force;
}
static_assert(limited() == 1);
static_assert([] {
  InputGate gate({}, period, true);
  return gate.step({0, 0, {0, 2e6, 0}, {0, -1, 0}, 0, true});
}() == Fault::non_finite_input);

/// A thumb that pushes a closed syringe: the pressure holds it back, N.
static_assert([] {
  Plunger plunger({0.01, 1e-6, 1e-6, 0.5, 1e-13, 1e9}, coupling, period);
  plunger.step(0, {1e15, 0});
  return plunger.step(1e-3, {1e15, 0});
}() < -0.5);

/// The forces of a stroke in and out, on a line and in space (N).
constexpr std::size_t ticks = 40;
struct Forces {
  std::array<double, ticks> line{}, space{};
};
template <typename L, typename C>
constexpr Forces forces(const L& law, const C& c, Solver solver) {
  Proxy1d<L, C> line(law, c, solver);
  Proxy3d<L, C> space(law, {0, 1e-3, 0}, {0.6, -0.8, 0}, c, solver);
  Forces f;
  for (std::size_t k = 0; k < ticks; ++k) {
    const double depth = -1e-3 + 5e-4 * static_cast<double>(k < 24 ? k : 47 - k);
    f.line[k] = line.step(depth);
    f.space[k] = space.step({0, 1e-3 - depth, 1e-4}, {0, -1, 0}).norm();
  }
  return f;
}
constexpr SampledCoupling<double> sampled(coupling, period);
constexpr Forces paper = forces(thick_law, sampled, Solver::paper), exact = forces(thick_law, sampled, Solver::exact),
                 tissue = forces(measured, relaxing, Solver::exact),
                 own = forces(test::CutLaw{}, sampled, Solver::exact);  // its pieces are looked at for flaws
static_assert(near(own.line[23], -1) && own.space[23] > 0.7);

#ifdef PUNCTURA_WHOLE_TICKS
/// The forces of the device in whole ticks: gate, conditioning, proxies, fade, limits. The direction and the sub-steps
/// of the second run are those of a device without orientation.
constexpr std::size_t steps = 64;
template <typename... Options>
constexpr std::array<double, steps> whole_ticks(const SampledCoupling<double>& c, Options... options) {
  const SiteOf<BasicThickLaw<double>> sites[] = {{thick_law, {0, 0, 0}, {0, -1, 0}},
                                                 {thick_law, {0, -2e-3, 0}, {0, -1, 0}}};
  using Insertion = InsertionOf<BasicThickLaw<double>>;
  ServoStepOf<Insertion> step(Insertion(sites, c, period, options...), period, {}, {.ramp_time = period});
  step.arm();
  std::array<double, steps> force{};
  for (std::size_t k = 0; k < steps; ++k) {
    const double y = 1e-3 - 1.5e-4 * static_cast<double>(k < 48 ? k : 95 - k);
    force[k] = step.step({k, static_cast<double>(k) * period, {0, y, 0}, {0, -1, 0}, 0, true}).force[1];
  }
  return force;
}
constexpr auto without_orientation(const SampledCoupling<double>& c) {
  return whole_ticks(c, Solver::paper, 0.0, Direction::motion, Conditioning::line_fit, 0.0, std::uint32_t{2});
}
constexpr auto plain_ticks = whole_ticks(sampled), other_ticks = without_orientation(sampled);
static_assert(plain_ticks[40] > 0.5 && plain_ticks[63] < 0 && other_ticks[40] > 0.5);
#endif

}  // namespace

TEST_CASE("both solvers give the same bits while the program is compiled and while it runs") {
  volatile double stiffness = coupling.stiffness;  // the compiler does not know it
  const SampledCoupling<double> now({stiffness, coupling.damping}, period);
  const Forces paper_now = forces(thick_law, now, Solver::paper), exact_now = forces(thick_law, now, Solver::exact);
  CHECK(paper_now.line == paper.line);
  CHECK(paper_now.space == paper.space);
  CHECK(exact_now.line == exact.line);
  CHECK(exact_now.space == exact.space);
  const Forces own_now = forces(test::CutLaw{}, now, Solver::exact);
  CHECK(own_now.line == own.line);
  CHECK(own_now.space == own.space);
#ifdef PUNCTURA_WHOLE_TICKS
  CHECK(whole_ticks(now) == plain_ticks);
  CHECK(without_orientation(now) == other_ticks);
#endif
  auto constants = relaxing.constants();
  constants.K = stiffness;
  const Forces tissue_now = forces(measured, RelaxingCoupling<double>(constants), Solver::exact);
  CHECK(tissue_now.line == tissue.line);
  CHECK(tissue_now.space == tissue.space);
}

TEST_CASE("the square root of a constant is that of the processor") {
  static_assert(lane::sqrt(0.0) == 0 && lane::sqrt(2.0f) == 1.41421356f && !lane::finite(lane::sqrt(-1.0)));
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto x = std::bit_cast<double>(random() >> 1);  // any exponent, denormal numbers, infinity and NaN
    const double mine = detail::constant_sqrt(x), root = std::sqrt(x);
    CHECK((mine == root || (std::isnan(mine) && std::isnan(root))));
  }
  for (const double x : {0x1p-1074, 0x1.fffffffffffffp1023, 0x1.fffffffffffffp0, 0x1.ffffffffffffep1, 4.0})
    CHECK(detail::constant_sqrt(x) == std::sqrt(x));
}

}  // namespace punctura::constant_test
