// Several laws in one scene. Each has the forces, and the memory, that it has alone.
#include "punctura/proxy/mixed_law.hpp"

#include <doctest/doctest.h>

#include "../support/allocations.hpp"
#include "../support/cut_law.hpp"
#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "../support/random_tissue.hpp"
#include "../support/tick.hpp"
#include "punctura/lab/events/crossing.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// K06's wall. After a withdrawal its grip is half as strong, up to the deepest point of the tip.
struct HalfLaw {
  using Scalar = double;
  struct Memory {
    double cut = 0, made = 0;
    static void archive(auto& self, auto& state) { state.fields(self.cut, self.made); }
  };
  using Pieces = ThickLaw::Pieces;
  ThickLaw law;

  const Pieces& pieces() const noexcept { return law.pieces(); }
  Pieces pieces(double cos_beta) const noexcept { return law.pieces(cos_beta); }
  Pieces pieces(double cos_beta, const Memory& memory) const noexcept {
    Pieces all = law.pieces(cos_beta);
    if (memory.made > 0)
      for (auto& piece : all.pieces) piece.lower = {piece.lower.c0 / 2, piece.lower.c1 / 2, piece.lower.c2 / 2};
    return all;
  }
  bool advance(Memory& memory, double depth) const noexcept {
    if (!(depth > memory.cut)) return false;
    memory.cut = depth;
    return true;
  }
  bool leave(Memory& memory) const noexcept {
    if (!(memory.made < memory.cut)) return false;
    memory.made = memory.cut;
    return true;
  }
};
using FourLaws = MixedLaw<ThickLaw, HalfLaw, TissueLaw, CutLaw>;
static_assert(HearsLeaving<HalfLaw> && HearsLeaving<FourLaws> && !HearsLeaving<MixedLaw<ThickLaw, CutLaw>>);
static_assert(RefreshesPieces<MixedLaw<ThickLaw, TissueLaw>> && !RefreshesPieces<FourLaws>);  // HalfLaw does not

/// leave() allows exceptions, so it is not heard.
struct DeafLaw : HalfLaw {
  bool leave(Memory& memory) const { return HalfLaw::leave(memory); }
};
static_assert(memory_is_whole<HalfLaw> && memory_is_whole<FourLaws> && LawWithMemory<DeafLaw> &&
              !memory_is_whole<DeafLaw>);

/// Strokes through a wall, each deeper than the one before.
std::vector<double> deeper_strokes(double reach) {
  std::vector<double> way;
  for (const double deep : {0.4, 0.7, 1.3})
    for (int k = 0; k <= 1200; ++k) way.push_back(-1e-3 + (deep * reach + 1e-3) * (1 - std::abs(k - 600) / 600.0));
  return way;
}

/// A law has the same bits alone and as a MixedLaw, on a line and in space, also after its state is loaded.
template <typename AsMixed, typename L>
void has_the_same_bits(const L& law, double reach) {
  for (Solver solver : {Solver::paper, Solver::exact}) {
    Proxy1d alone(law, Coupling{400, 1}, T, solver);
    Proxy1d among(AsMixed(law), Coupling{400, 1}, T, solver);
    const Vector3d down(0, -1, 0), axis = Vector3d(0.2, -1, 0.1).stableNormalized();
    Proxy3d alone_3d(law, Vector3d(), down, Coupling{400, 1}, T, solver);
    Proxy3d among_3d(AsMixed(law), Vector3d(), down, Coupling{400, 1}, T, solver);
    std::size_t k = 0;
    for (const double p : deeper_strokes(reach)) {
      REQUIRE(among.step(p) == alone.step(p));
      REQUIRE(among_3d.step(p * axis, axis) == alone_3d.step(p * axis, axis));
      if (++k % 500 == 0) REQUIRE(load_state(among, save_state(among)));
      if (k % 500 == 0) REQUIRE(load_state(among_3d, save_state(among_3d)));
    }
    CHECK(among.depth() == alone.depth());
  }
}

}  // namespace

TEST_CASE("a law has the same forces alone and in a MixedLaw, with everything that it remembers") {
  const double reach = tip_length(paper_needle) + 1e-3;
  has_the_same_bits<FourLaws>(ThickLaw(paper_needle, paper_membrane(1e-3), 0.5), reach);
  has_the_same_bits<FourLaws>(HalfLaw{ThickLaw(paper_needle, paper_membrane(1e-3))}, reach);
  has_the_same_bits<FourLaws>(CutLaw{}, reach);
  Noise noise(160);
  for (int i = 0; i < 4; ++i) {
    const TissueCase c = random_tissue(noise);
    has_the_same_bits<FourLaws>(c.law(), std::min(c.reach(), 0.03));
    has_the_same_bits<MixedLaw<ThickLaw, TissueLaw>>(c.law(), std::min(c.reach(), 0.03));
    const Crossing one = crossing(c.law(), c.needle, c.membrane.thickness, 0.9);
    const Crossing other = crossing(FourLaws(c.law()), c.needle, c.membrane.thickness, 0.9);
    CHECK(one.peak == other.peak);
    CHECK(one.through == other.through);
    CHECK(one.settled == other.settled);
  }
}

TEST_CASE("a law that hears leaving hears it in a MixedLaw: the second stroke is half as hard") {
  Proxy3d proxy(FourLaws(HalfLaw{ThickLaw(paper_needle, paper_membrane(1e-3))}), {}, {0, -1, 0}, Coupling{400, 1}, T);
  double peak[2] = {};
  for (double& most : peak)
    for (int k = 0; k <= 3200; ++k)
      most = std::max(most, proxy.step({0, 1e-3 - 12e-3 * (1 - std::abs(k - 1600) / 1600.0), 0}, {0, -1, 0}).y());
  CHECK(peak[0] > 0.5);
  CHECK(peak[1] == doctest::Approx(peak[0] / 2).epsilon(1e-2));
}

TEST_CASE("a scene can mix laws, and a tick allocates no memory") {
  Scene scene = paper_scene(1e-3);
  scene.servo.low_pass = 0;
  scene.membranes.push_back({"cut", paper_membrane(1e-3), {0, -4e-3, 0}, {0, -1, 0}});
  for (Solver solver : {Solver::paper, Solver::exact}) {
    scene.servo.solver = solver;
    auto mixed = build_insertion<double>(scene, [](const Needle& needle, const Membrane& membrane, std::size_t i) {
      return i == 0 ? FourLaws(ThickLaw(needle, membrane)) : FourLaws(CutLaw{});
    });
    Proxy3d wall(ThickLaw(paper_needle, paper_membrane(1e-3)), {0, 0, 0}, {0, -1, 0}, scene.coupling, T, solver);
    Proxy3d cut(CutLaw{}, {0, -4e-3, 0}, {0, -1, 0}, scene.coupling, T, solver);
    Noise noise(91);
    const Vector3d down(0, -1, 0);
    for (double p : random_motion(noise, 3000, 12e-3, T)) {
      const Vector3d tip = p * down;
      const auto before = allocations();
      const Vector3d force = mixed.step(tip, down);
      REQUIRE(allocations() == before);
      REQUIRE(force == Vector3d() + wall.step(tip, down) + cut.step(tip, down));
    }
    CHECK(cut.state().law.cut > 1e-3);
  }
}

TEST_CASE("a law of another kind that comes while the tip is inside gives no force until the tip was in front") {
  const auto of = [](const auto& law) {
    return build<double>(paper_scene(1e-3), [law](auto&&...) { return MixedLaw<ThickLaw, TissueLaw, CutLaw>(law); });
  };
  auto firmer = paper_membrane(1e-3);
  firmer.stiffness = 700;
  const ThickLaw wall(paper_needle, paper_membrane(1e-3)), firm(paper_needle, firmer);
  const TissueLaw tissue(paper_needle, paper_membrane(1e-3), {});
  const auto phase_after = [&](const auto& before, const auto& after) {
    auto step = of(before), next = of(after);
    step.arm();
    std::uint64_t k = 0;
    for (; k < 1600; ++k) step.step(reading(k, 2e-3 - 5e-3 * static_cast<double>(k) / 1600));
    const double held = step.snapshot().force[1];
    CHECK(held > 0.3);
    next.resume(step);
    const Phase phase = next.step(reading(k++, -3e-3)).membranes[0].phase;
    if (phase == Phase::barred) {
      for (double last = held; k < 2000; ++k) {
        const double force = next.step(reading(k, -3e-3)).force[1];
        CHECK(force <= last);
        CHECK(last - force < 1.01 * held * T / ServoStep::fade_time);
        last = force;
      }
      CHECK(next.snapshot().force == std::array<double, 3>{});
      for (int i = 1; i <= 3200; ++i) next.step(reading(k++, i < 1600 ? -3e-3 + 3e-6 * i : 1.8e-3 - 3e-6 * (i - 1600)));
      CHECK(next.snapshot().force[1] > 0.3);
      CHECK(next.snapshot().membranes[0].phase != Phase::barred);
    }
    return phase;
  };
  CHECK(phase_after(wall, CutLaw{}) == Phase::barred);
  CHECK(phase_after(CutLaw{}, wall) == Phase::barred);
  CHECK(phase_after(CutLaw{}, CutLaw{}) != Phase::barred);
  CHECK(phase_after(wall, firm) != Phase::barred);
  CHECK(phase_after(wall, tissue) != Phase::barred);  // both are laws of the package
}

TEST_CASE("a law inside two MixedLaws is told from another one") {
  using Inner = MixedLaw<CutLaw, HalfLaw>;
  using Outer = MixedLaw<ThickLaw, Inner>;
  const ThickLaw wall(paper_needle, paper_membrane(1e-3));
  const Outer cut(Inner(CutLaw{})), half(Inner(HalfLaw{wall}));
  CHECK(goes_on_from(cut, cut));
  CHECK(goes_on_from(half, half));
  CHECK(!goes_on_from(cut, half));
  CHECK(!goes_on_from(cut, Outer(wall)));

  struct Own : CutLaw {
    int kind = 0;
    constexpr bool goes_on_from(const Own& before) const noexcept { return kind == before.kind; }
  };
  CHECK(goes_on_from(Own{{}, 1}, Own{{}, 1}));
  CHECK(!goes_on_from(Own{{}, 1}, Own{{}, 2}));
}

TEST_CASE("a kept state of another kind of law is refused, also if both have the same pieces") {
  const ThickLaw wall(paper_needle, paper_membrane(1e-3));
  const auto of = [](const FourLaws& law) { return Proxy3d(law, {}, {0, -1, 0}, Coupling{400, 1}, T); };
  auto plain = of(wall), half = of(HalfLaw{wall});
  CHECK(load_state(half, save_state(half)));
  CHECK(!load_state(half, save_state(plain)));
}

TEST_CASE("measured tissue that gives back more than its grip is no law") {
  Tissue tissue;
  for (const double set : {-0.1, 1.01, 50.0}) {
    tissue.set = set;
    std::vector<Problem> problems;
    CHECK(!try_build<double>(paper_scene(1e-3), problems,
                             [&](const Needle& n, const Membrane& m, std::size_t) { return TissueLaw(n, m, tissue); }));
    CHECK(problems.size() == 1);
  }
}
