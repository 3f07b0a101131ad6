// Both solvers with four lanes. Each lane has the bits of a single run.
#include <doctest/doctest.h>

#include <bit>

#include "../support/allocations.hpp"
#include "../support/cases.hpp"
#include "../support/four_lanes.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/proxy/exact.hpp"
#include "punctura/proxy/paper.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr std::size_t ticks = 1500;

template <typename Mask>
concept MayBeRead = requires(Mask mask) { mask ? 1 : 0; };
static_assert(MayBeRead<Mask<double>> && !MayBeRead<Mask<FourLanes<double>>>,
              "an if that reads one lane for all must not compile");
template <typename V, typename Law>
constexpr bool is_plain_data =
    std::is_trivially_copyable_v<LineState<Law>> && std::is_trivially_copyable_v<SpaceState<Law>> &&
    std::is_trivially_copyable_v<LineParams<Law>> && std::is_trivially_copyable_v<SpaceParams<Law>> &&
    std::is_trivially_copyable_v<SpaceTick<V>>;
static_assert(is_plain_data<FourLanes<float>, BasicThickLaw<FourLanes<float>>>);

template <typename Scalar>
Scalar of_lane(const FourLanes<Scalar>& v, std::size_t i) {
  return v.lane[i];
}
template <typename Scalar>
Vector3<Scalar> of_lane(const Vector3<FourLanes<Scalar>>& v, std::size_t i) {
  return {v.x().lane[i], v.y().lane[i], v.z().lane[i]};
}
template <typename Scalar>
Phase of_lane(const Phases<FourLanes<Scalar>>& phases, std::size_t i) {
  return static_cast<Phase>(phases.number.lane[i]);
}
template <typename Scalar>
FourLanes<Scalar> together(const std::array<Scalar, 4>& numbers) {
  FourLanes<Scalar> v;
  v.lane = numbers;
  return v;
}

template <std::floating_point Scalar>
bool same_bits(Scalar a, Scalar b) {
  using Bits = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}
template <typename Scalar>
bool same_bits(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

template <typename Scalar>
bool same_band(const Band<FourLanes<Scalar>>& lanes, std::size_t i, const Band<Scalar>& one) {
  return same_bits(of_lane(lanes.lower, i), one.lower) && same_bits(of_lane(lanes.upper, i), one.upper);
}

/// Four laws and couplings in Scalar.
template <typename Scalar>
struct Cases {
  std::array<BasicNeedle<Scalar>, 4> needle;
  std::array<BasicMembrane<Scalar>, 4> membrane;
  std::array<BasicCoupling<Scalar>, 4> coupling;
  std::array<double, 4> reach{};  ///< of motions through all pieces of the law, m

  explicit Cases(Noise& noise) {
    for (std::size_t i = 0; i < 4; ++i) {
      LawCase c = random_law(noise, 1e-6);  // thin walls: (29) has several solutions there
      if (noise.uniform() < 0.2) c.membrane.thickness = 0;
      const BasicCoupling<double> k = random_coupling(noise);
      const auto to = [](double x) { return static_cast<Scalar>(x); };
      needle[i] = {to(c.needle.diameter), to(c.needle.tip_angle)};
      membrane[i] = {to(c.membrane.stiffness), to(c.membrane.precompression), to(c.membrane.friction),
                     to(c.membrane.thickness)};
      coupling[i] = {to(k.stiffness), to(k.damping)};
      reach[i] = LawConstants<double>(c.needle, c.membrane).X + 2 * c.membrane.thickness + 2e-3;
    }
  }

  template <typename Of>
  FourLanes<Scalar> all(Of of) const {
    return together<Scalar>({of(0), of(1), of(2), of(3)});
  }
  template <template <typename> typename Law>
  Law<FourLanes<Scalar>> law() const {
    return {{all([&](std::size_t i) { return needle[i].diameter; }),
             all([&](std::size_t i) { return needle[i].tip_angle; })},
            {all([&](std::size_t i) { return membrane[i].stiffness; }),
             all([&](std::size_t i) { return membrane[i].precompression; }),
             all([&](std::size_t i) { return membrane[i].friction; }),
             all([&](std::size_t i) { return membrane[i].thickness; })}};
  }
  SampledCoupling<FourLanes<Scalar>> couplings() const {
    return {{all([&](std::size_t i) { return coupling[i].stiffness; }),
             all([&](std::size_t i) { return coupling[i].damping; })},
            static_cast<Scalar>(T)};
  }
};

/// How often the lanes had each phase, and in how many ticks they had different phases.
struct Seen {
  std::array<int, 5> phases{};
  int different = 0;

  void count(const std::array<Phase, 4>& lanes) {
    for (Phase phase : lanes) ++phases[static_cast<std::size_t>(phase)];
    different += lanes != std::array{lanes[0], lanes[0], lanes[0], lanes[0]};
  }
};

template <typename Solver, template <typename> typename Law, typename Scalar>
void compare_on_a_line(Noise& noise, Seen& seen) {
  const Cases<Scalar> cases(noise);
  const LineParams<Law<FourLanes<Scalar>>> params{cases.template law<Law>(), cases.couplings()};
  LineState<Law<FourLanes<Scalar>>> state{};
  std::array<std::vector<double>, 4> motion;
  std::array<LineState<Law<Scalar>>, 4> states{};
  std::vector<LineParams<Law<Scalar>>> alone;
  for (std::size_t i = 0; i < 4; ++i) {
    motion[i] = random_motion(noise, ticks, cases.reach[i], T);
    alone.push_back({{cases.needle[i], cases.membrane[i]}, {cases.coupling[i], static_cast<Scalar>(T)}});
  }
  for (std::size_t k = 0; k < ticks; ++k) {
    const auto p = cases.all([&](std::size_t i) { return static_cast<Scalar>(motion[i][k]); });
    const auto before = allocations();
    const auto tick = Solver::step(params, state, p);
    if (allocations() != before) FAIL("tick " << k << " takes memory");
    std::array<Phase, 4> phases;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto one = Solver::step(alone[i], states[i], p.lane[i]);
      phases[i] = one.phase;
      const bool same = same_bits(of_lane(tick.force, i), one.force) && same_bits(of_lane(tick.proxy, i), one.proxy) &&
                        same_band(tick.band, i, one.band) && same_bits(of_lane(tick.depth, i), one.depth) &&
                        of_lane(tick.phase, i) == one.phase && of_lane(state.phase, i) == states[i].phase &&
                        same_bits(of_lane(state.e, i), states[i].e);
      if (!same) FAIL("tick " << k << ", lane " << i);
    }
    seen.count(phases);
  }
}

template <typename Solver, typename Scalar>
void compare_in_space(Noise& noise, Seen& seen) {
  using V = FourLanes<Scalar>;
  const Cases<Scalar> cases(noise);
  std::array<Vector3<Scalar>, 4> point, normal, axis;
  std::array<std::vector<double>, 4> motion;
  std::array<SpaceState<BasicThickLaw<Scalar>>, 4> states{};
  std::vector<SpaceParams<BasicThickLaw<Scalar>>> alone;
  const auto direction = [&](double spread) {
    const Vector3d v{between(noise, -spread, spread), -1, between(noise, -spread, spread)};
    return v.stableNormalized().template cast<Scalar>();
  };
  for (std::size_t i = 0; i < 4; ++i) {
    point[i] = Vector3d{between(noise, -0.1, 0.1), 0, between(noise, -0.1, 0.1)}.cast<Scalar>();
    normal[i] = direction(0.5);
    motion[i] = random_motion(noise, ticks, 3 * cases.reach[i], T);
    if (noise.uniform() < 0.3) motion[i].erase(motion[i].begin(), motion[i].begin() + ticks / 4);  // some start inside
    motion[i].resize(ticks);
    alone.push_back(
        {{cases.needle[i], cases.membrane[i]}, point[i], normal[i], {cases.coupling[i], static_cast<Scalar>(T)}});
  }
  const auto all = [&](const std::array<Vector3<Scalar>, 4>& v) {
    return Vector3<V>{cases.all([&](std::size_t i) { return v[i].x(); }),
                      cases.all([&](std::size_t i) { return v[i].y(); }),
                      cases.all([&](std::size_t i) { return v[i].z(); })};
  };
  const SpaceParams<BasicThickLaw<V>> params{cases.template law<BasicThickLaw>(), all(point), all(normal),
                                             cases.couplings()};
  SpaceState<BasicThickLaw<V>> state{};
  for (std::size_t k = 0; k < ticks; ++k) {
    std::array<Vector3<Scalar>, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      if (k % 100 == 0) {  // often oblique, sometimes beyond 80 degrees, sometimes from behind
        axis[i] = direction(noise.uniform() < 0.2 ? 20 : 1);
        if (noise.uniform() < 0.1) axis[i] = -axis[i];
      }
      p[i] = point[i] + normal[i] * static_cast<Scalar>(motion[i][k]) +
             axis[i] * static_cast<Scalar>(1e-4 * noise.uniform());
    }
    const auto before = allocations();
    const auto tick = Solver::step(params, state, all(p), all(axis));
    if (allocations() != before) FAIL("tick " << k << " takes memory");
    std::array<Phase, 4> phases;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto one = Solver::step(alone[i], states[i], p[i], axis[i]);
      phases[i] = one.phase;
      const bool same = same_bits(of_lane(tick.force, i), one.force) && same_bits(of_lane(tick.proxy, i), one.proxy) &&
                        same_bits(of_lane(tick.direction, i), one.direction) && of_lane(tick.phase, i) == one.phase &&
                        same_bits(of_lane(tick.axial_force, i), one.axial_force) && same_band(tick.band, i, one.band) &&
                        same_bits(of_lane(tick.depth, i), one.depth) && of_lane(state.phase, i) == states[i].phase &&
                        same_bits(of_lane(state.e, i), states[i].e) &&
                        same_bits(of_lane(state.cos_beta, i), states[i].cos_beta);
      if (!same) FAIL("tick " << k << ", lane " << i);
    }
    seen.count(phases);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("on a line, each of four lanes has the bits of a single run" * doctest::test_suite("numbers"),
                   Scalar, double, float) {
  Noise noise(120);
  Seen paper, exact;
  for (int k = 0; k < cases(20); ++k) {
    compare_on_a_line<Paper, BasicThinLaw, Scalar>(noise, paper);
    compare_on_a_line<Paper, BasicThickLaw, Scalar>(noise, paper);
    compare_on_a_line<Exact, BasicThinLaw, Scalar>(noise, exact);
    compare_on_a_line<Exact, BasicThickLaw, Scalar>(noise, exact);
  }
  for (const Seen& seen : {paper, exact}) {
    for (Phase phase : {Phase::sticking, Phase::sliding_in, Phase::sliding_out})
      CHECK(seen.phases[static_cast<std::size_t>(phase)] > 1000);
    CHECK(seen.different > 1000);
  }
}

TEST_CASE_TEMPLATE("in space, each of four lanes has the bits of a single run" * doctest::test_suite("numbers"), Scalar,
                   double, float) {
  Noise noise(121);
  Seen paper, exact;
  for (int k = 0; k < cases(40); ++k) {
    compare_in_space<Paper, Scalar>(noise, paper);
    compare_in_space<Exact, Scalar>(noise, exact);
  }
  for (const Seen& seen : {paper, exact}) {
    for (int n : seen.phases) CHECK(n > 1000);
    CHECK(seen.different > 1000);
  }
}

// The motions above use few combinations of pieces. Here each piece is a start and an end.
TEST_CASE_TEMPLATE("masked_slide() has the bits of slide()", Scalar, double, float) {
  Noise noise(122);
  std::array<int, 5> started{};
  int pops = 0;
  for (int k = 0; k < cases(400); ++k) {
    const Cases<Scalar> c(noise);
    const auto pieces =
        BasicThickLaw<Scalar>(c.needle[0], c.membrane[0]).pieces(static_cast<Scalar>(between(noise, 0.2, 1)));
    const Scalar deepest = pieces.breaks[3];
    for (int j = 0; j < 200; ++j) {
      Scalar q = static_cast<Scalar>(between(noise, -0.2, 1.2)) * deepest;
      if (j % 10 == 0) q = pieces.breaks[static_cast<std::size_t>(j / 10) % 4];
      const auto g = static_cast<Scalar>(between_log(noise, 1, 1e5)), f = static_cast<Scalar>(between(noise, -30, 30));
      const std::size_t i = pieces.index(q);
      const auto band = pieces.band(q, i);
      if (f < band.lower) {
        ++started[i];
        const Scalar force = slide<+1>(pieces, i, q, f, g);
        pops += pieces.index(q + (force - f) / g) > i + 1;
        REQUIRE(same_bits(masked_slide<+1>(pieces, q, f, g), force));
      }
      if (f > band.upper) REQUIRE(same_bits(masked_slide<-1>(pieces, q, f, g), slide<-1>(pieces, i, q, f, g)));
    }
  }
  for (int n : started) CHECK(n > cases(400) / 10);
  CHECK(pops > cases(400) / 10);
}
