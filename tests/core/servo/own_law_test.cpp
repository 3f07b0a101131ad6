// The whole servo step, with gate and limits, with custom laws.
#include <doctest/doctest.h>

#include <limits>

#include "../support/allocations.hpp"
#include "../support/cut_law.hpp"
#include "../support/given_law.hpp"
#include "../support/paper_scene.hpp"
#include "punctura/proxy/mixed_law.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

using Mixed = MixedLaw<ThickLaw, CutLaw>;
using OwnStep = ServoStepOf<InsertionOf<Mixed>>;

/// The wall of K06 at y = 0, and 4 mm behind it a membrane with CutLaw.
Scene wall_and_cut(double stiffness = 570) {
  Scene scene = paper_scene(1e-3);
  scene.membranes[0].membrane.stiffness = stiffness;
  scene.membranes.push_back({"cut", paper_membrane(1e-3), {0, -4e-3, 0}, {0, -1, 0}});
  return scene;
}
Mixed own_law(const Needle& needle, const Membrane& membrane, std::size_t i) {
  return i == 0 ? Mixed(ThickLaw(needle, membrane)) : Mixed(CutLaw{});
}
static_assert(std::same_as<decltype(build<double>(Scene{}, own_law)), OwnStep>);
static_assert(std::same_as<ServoStepOf<Insertion>, ServoStep>);
static_assert(noexcept(std::declval<OwnStep&>().step(std::declval<const DeviceSample&>())) &&
              noexcept(std::declval<OwnStep&>().resume(std::declval<OwnStep&>())));

double cut_of(const OwnStep& step) {
  const auto& memory = step.insertion().proxies()[1].state().law;
  const auto* cut = std::get_if<1>(static_cast<const Mixed::Memory::Each*>(&memory));
  return cut ? cut->cut : 0;
}

/// Moves the tip along y at 20 mm/s, one healthy sample per tick. It checks that no tick allocates memory.
struct CutDriver {
  double y = 2e-3;
  std::uint64_t k = 0;

  template <typename Check>
  Snapshot move_to(OwnStep& step, double goal, Check check) {
    Snapshot last{};
    do {
      y += std::clamp(goal - y, -20e-3 / 1600, 20e-3 / 1600);
      const auto before = allocations();
      const Snapshot& s = step.step(reading(k++, y));
      REQUIRE(allocations() == before);
      check(s);
      last = s;
    } while (y != goal);
    return last;
  }
  Snapshot move_to(OwnStep& step, double goal) {
    return move_to(step, goal, [](const Snapshot&) {});
  }
};

}  // namespace

TEST_CASE("gate, ramp, fault, reset and a new scene work with a law with memory") {
  OwnStep step = build<double>(wall_and_cut(), own_law);
  auto model = build_insertion<double>(wall_and_cut(), own_law);
  CutDriver hand;

  // disarmed: the model runs, and the device gets no force
  hand.move_to(step, 1e-3, [&](const Snapshot& s) {
    model.step(to_vector(s.sample.position), to_vector(s.sample.axis));
    CHECK(s.force == std::array<double, 3>{});
  });

  // armed: the ramp scales the force of the model, then the whole force goes to the device
  step.arm();
  int ramped = 0;
  Snapshot last = hand.move_to(step, -10e-3, [&](const Snapshot& s) {
    const Vector3d force = model.step(to_vector(s.sample.position), to_vector(s.sample.axis));
    REQUIRE(to_vector(s.model_force) == force);
    REQUIRE(std::abs(s.force[1]) <= std::abs(s.model_force[1]));
    ramped += s.limit == Limit::ramp;
  });
  CHECK(ramped > 100);
  CHECK(last.state == ServoState::active);
  CHECK(last.force == last.model_force);
  CHECK(last.membranes[1].axial_force == doctest::Approx(-1));  // the force of CutLaw
  CHECK(last.membrane_count == 2);

  // a change of scene during the insertion: the cut stays, and the force does not jump
  const double cut = cut_of(step);
  CHECK(cut > 3e-3);
  OwnStep next = build<double>(wall_and_cut(300), own_law);
  next.resume(step);
  CHECK(cut_of(next) == cut);
  const Snapshot first = hand.move_to(next, hand.y);
  CHECK(first.commands == command_scene);
  CHECK(std::abs(first.force[1] - last.force[1]) < 1e-3);
  CHECK(std::abs(first.model_force[1] - last.model_force[1]) > 0.05);
  for (int k = 0; k < 400; ++k) hand.move_to(next, hand.y);
  CHECK(next.snapshot().force == next.snapshot().model_force);

  // a fault is latched; reset() also clears the cut and disarms
  DeviceSample broken = reading(hand.k++, hand.y);
  broken.healthy = false;
  CHECK(next.step(broken).fault == Fault::device);
  last = hand.move_to(next, -9e-3, [](const Snapshot& s) { CHECK(s.force == std::array<double, 3>{}); });
  CHECK(last.state == ServoState::faulted);
  next.reset();
  CHECK(cut_of(next) == 0);
  CHECK(next.state() == ServoState::disarmed);

  // armed inside tissue: no force until the tip has been outside
  next.arm();
  hand.move_to(next, 2e-3, [](const Snapshot& s) {
    CHECK((s.state == ServoState::waiting || s.membranes[0].phase == Phase::outside));
  });
  CHECK(next.state() == ServoState::active);
  last = hand.move_to(next, -10e-3);
  CHECK(last.membranes[1].axial_force == doctest::Approx(-1));
  CHECK(last.force[1] > 1);
}

TEST_CASE("the peak limit acts on the force of a custom law") {
  ForceLimits limits;
  limits.max_force = 0.5;
  OwnStep step = build<double>(wall_and_cut(), own_law, {}, limits);
  step.arm();
  CutDriver hand;
  const Snapshot last = hand.move_to(step, -10e-3);
  CHECK(last.model_force[1] > 1);
  CHECK(std::hypot(last.force[0], last.force[1], last.force[2]) == doctest::Approx(0.5));
  CHECK(last.limits.peak > 0);
}

namespace {
using ThreePieces = PiecewiseBand<double, 3>;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
constexpr BandPiece<double> holds{0, {-0.3}, {0.3}};
constexpr BandPiece<double> hump{0, {-0.1, 2000, -1e6}, {0.1, 2000, -1e6}};  // its lower edge is 0.9 N at 1 mm
constexpr ThreePieces sound{{0, 1}, {{{}, holds, holds}}};
ThreePieces with_band(Quadratic<double> lower, Quadratic<double> upper) {
  return {{0, 1}, {{{}, {0, lower, upper}, holds}}};
}

/// After 1 s, its pieces are others.
struct FailingLaw {
  using Scalar = double;
  struct Memory {
    double time;
  };
  ThreePieces then;

  ThreePieces pieces(double = 1, const Memory& memory = {}) const noexcept { return memory.time > 1 ? then : sound; }
  bool advance(Memory& memory, double, double dt) const noexcept { return memory.time += dt, true; }
};
/// Beyond 30 degrees, its pieces are others.
struct ObliquelyFailingLaw {
  using Scalar = double;
  ThreePieces then;
  const ThreePieces& pieces() const noexcept { return sound; }
  ThreePieces pieces(double cos_beta) const noexcept { return cos_beta < 0.87 ? then : sound; }
};
const std::vector<ThreePieces> no_laws{
    with_band({no_number}, {no_number}),
    with_band({no_number}, {0.3}),
    with_band({-0.3}, {no_number}),
    with_band({-infinity}, {0.3}),
    with_band({0.3}, {-0.3}),
    with_band({0.2}, {0.3}),
    with_band({-0.3}, {-4.5}),
    with_band({-0.3, 0, 1e5}, {0.3}),  // its lower edge rises above the upper one, deeper than the tip is
    {{0, 1}, {{{}, holds, {0, {-0.3, -1}, {0.3}}}}},  // falls behind the last break
    {{0, infinity}, {{{}, {0, {-0.1, 1000}, {0.1}}, holds}}},
    {{0, 2e-3}, {{{}, hump, holds}}},
    {{0, 1}, {{holds, holds, holds}}},
    {{2e-3, 1e-3}, {{{}, holds, holds}}},
    {{-1e-3, 1}, {{{}, holds, holds}}},
    {{0, no_number}, {{{}, holds, holds}}},
    {{no_number, 1}, {{{}, holds, holds}}}};
}  // namespace

TEST_CASE("a law that breaks its word in a run is a fault before the hand feels it") {
  Scene scene = paper_scene(1e-3);
  for (const Solver solver : {Solver::paper, Solver::exact})
    for (std::size_t i = 0; i < no_laws.size(); ++i) {
      CAPTURE(i);
      scene.servo.solver = solver;
      const auto run = [&](auto step, Vector3d axis) {
        step.arm();
        double largest = 0;
        for (std::uint64_t k = 0; k < 2400; ++k) {
          DeviceSample sample = reading(k, 2e-3 - 10e-3 * static_cast<double>(k) / 1600);
          sample.axis = to_array(axis);
          const Snapshot& s = step.step(sample);
          largest = std::max(largest, to_vector(s.force).norm());
          if (s.fault != Fault::none) CHECK(s.force == std::array<double, 3>{});
        }
        CHECK(step.fault() == Fault::non_finite_force);
        return largest;
      };
      const FailingLaw in_time{no_laws[i]};
      const MixedLaw<ThickLaw, FailingLaw> among{in_time};
      const Vector3d along(0, -1, 0), oblique = Vector3d(0.8, -1, 0).stableNormalized();
      CHECK(run(build<double>(scene, [&](auto&&...) { return in_time; }), along) == doctest::Approx(0.3));
      CHECK(run(build<double>(scene, [&](auto&&...) { return among; }), along) == doctest::Approx(0.3));
      CHECK(run(build<double>(scene, [&](auto&&...) { return ObliquelyFailingLaw{no_laws[i]}; }), oblique) == 0);
    }
}

namespace {
/// After 1 s, its pieces are not those of its base.
struct DerivedLaw : ThickLaw {
  struct Memory {
    double time;
  };
  using ThickLaw::pieces;
  using ThickLaw::ThickLaw;
  Pieces pieces(double cos_beta, const Memory& memory) const noexcept {
    return memory.time > 1 ? with_room<5>(with_band({0.2}, {0.3})) : pieces(cos_beta);
  }
  bool advance(Memory& memory, double, double dt) const noexcept { return memory.time += dt, true; }
};
struct DerivedMixedLaw : MixedLaw<ThickLaw, TissueLaw> {
  using Base = MixedLaw<ThickLaw, TissueLaw>;
  using Base::Base;
};
static_assert(!MayHaveFlaws<ThickLaw> && !MayHaveFlaws<ProfileLaw> && !MayHaveFlaws<TissueLaw> &&
              !MayHaveFlaws<DerivedMixedLaw::Base>);
static_assert(MayHaveFlaws<DerivedLaw> && MayHaveFlaws<MixedLaw<ThickLaw, DerivedLaw>> &&
              MayHaveFlaws<DerivedMixedLaw>);
}  // namespace

TEST_CASE("a law derived from one of the package is checked in a run, alone and among others") {
  const auto run = [](auto step) {
    for (std::uint64_t k = 0; k < 2400; ++k) {
      step.step(reading(k, 2e-3 - 10e-3 * static_cast<double>(k) / 1600));
      if (k < 1500) CHECK(step.fault() == Fault::none);
    }
    CHECK(step.fault() == Fault::non_finite_force);
  };
  const DerivedLaw law(paper_needle, paper_membrane(1e-3));
  run(build<double>(paper_scene(1e-3), [&](auto&&...) { return law; }));
  run(build<double>(paper_scene(1e-3), [&](auto&&...) { return MixedLaw<ThickLaw, DerivedLaw>(law); }));

  const DerivedMixedLaw among(ThickLaw(paper_needle, paper_membrane(1e-3)));
  const auto bad = with_room<5>(with_band({0.2}, {0.3}));
  CHECK(!has_flaw(among, among.pieces()));
  CHECK(has_flaw(among, DerivedMixedLaw::Pieces(std::in_place_index<0>, bad)));
}

TEST_CASE("more pieces than a ManyPieces holds are a fault in the same tick, and a problem of a scene") {
  struct OverfullLaw {
    using Scalar = double;
    using Memory = double;  // s
    bool splits;
    ManyPieces<double, 4> pieces(double, const Memory& time) const noexcept {
      ManyPieces<double, 4> all;
      for (int i = 0; i < 3; ++i) all.add(i * 1e-3, holds);
      if (time > 1 && splits) all.split(1.5e-3);
      if (time > 1 && !splits) all.add(3e-3, holds);
      all.add(2e-3, holds);  // replaces the last piece
      return all;
    }
    bool advance(Memory& time, double, double dt) const noexcept { return time += dt, true; }
  };
  for (const bool splits : {false, true}) {
    auto step = build<double>(paper_scene(1e-3), [&](auto&&...) { return OverfullLaw{splits}; });
    step.arm();
    double largest = 0;
    for (std::uint64_t k = 0; k < 2400; ++k) {
      const Snapshot& s = step.step(reading(k, 2e-3 - 10e-3 * static_cast<double>(k) / 1600));
      largest = std::max(largest, to_vector(s.force).norm());
      if (k < 1599) CHECK(s.fault == Fault::none);
    }
    CHECK(step.fault() == Fault::non_finite_force);
    CHECK(largest == doctest::Approx(0.3));
    CHECK(words_for(find_flaw(OverfullLaw{splits}.pieces(1, 2))).find("too many pieces") != std::string::npos);
  }
}

TEST_CASE("an upper edge below 0 N, which pushes the needle out as in K06, is no fault") {
  auto step = build<double>(paper_scene(1e-3), [&](auto&&...) { return FailingLaw{with_band({-0.3}, {-0.1})}; });
  for (std::uint64_t k = 0; k < 2400; ++k) step.step(reading(k, 2e-3 - 10e-3 * static_cast<double>(k) / 1600));
  CHECK(step.fault() == Fault::none);
}

TEST_CASE("try_build() returns the problems of scene and limits, for a custom law and for K06's law") {
  Scene scene = wall_and_cut(-1);
  ForceLimits limits;
  limits.max_force = 0;
  std::vector<Problem> problems;
  CHECK(!try_build<double>(scene, problems, own_law, {}, limits));
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].path == "membrane[0].stiffness");
  CHECK(problems[1].path == "limits.max_force");
  CHECK_THROWS_AS(build<double>(scene, own_law), SceneError);
}

TEST_CASE("a law that is none is a problem of the scene, with its membrane and the depth") {
  using Table = PiecewiseBand<double, 3>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto problem_of = [](const Table& table) {
    std::vector<Problem> problems;
    auto made = try_build<double>(paper_scene(1e-3), problems, [&](auto&&...) { return GivenLaw<3>{table}; });
    CHECK(made.has_value() == problems.empty());
    return problems.empty() ? std::string() : line_of(problems.at(0));
  };
  const BandPiece<double> good{0, {-1, 2}, {1, -2}}, level{0, {-1}, {1}};
  CHECK(problem_of({{0, 1e-3}, {{{}, good, level}}}).empty());
  CHECK(problem_of({{0, infinity}, {{{}, level, level}}}).empty());
  CHECK(problem_of({{infinity, infinity}, {{{}, good, level}}}).empty());  // no depth is in the second piece

  std::vector<Problem> problems;  // of a law of core that is used as one's own
  CHECK(try_build<double>(paper_scene(1e-3), problems, [](Needle needle, Membrane membrane, auto) {
    return TissueLaw(needle, membrane, Tissue{});
  }));
  const auto faulty = [&](const Table& table, const char* words) {
    const std::string line = problem_of(table);
    CAPTURE(line);
    CHECK(line.starts_with("membrane[0]: the law: its "));
    CHECK(line.find(words) != std::string::npos);
  };
  for (const char* flaw : {"not finite", "not 0 in front of the first break", "not constant behind the last",
                           "above the upper one", "above 0 N", "in front of the surface", "out of order", "too many"})
    CHECK(std::string(describe(Fault::non_finite_force)).find(flaw) != std::string::npos);
  faulty({{0, 1e-3}, {{level, good, level}}}, "0 in front of the first break");
  faulty({{0, 1e-3}, {{{}, level, good}}}, "constant behind the last finite break");
  faulty({{0, infinity}, {{{}, {0, {-0.1, 1000}, {0.1}}, level}}}, "constant behind the last finite break");
  faulty({{0, infinity}, {{{}, {0, {-0.1}, {0.1, 0, 1}}, level}}}, "constant behind the last finite break");
  faulty({{-1e-3, 1e-3}, {{{}, good, level}}}, "break 0 must be at 0 m or deeper");
  faulty({{2e-3, 1e-3}, {{{}, good, level}}}, "break 1 must be at 0.002 m or deeper");
  faulty({{0, nan}, {{{}, good, level}}}, "break 1 must be at 0 m");
  faulty({{0, 1e-3}, {{{}, {0, {1}, {-1}}, level}}}, "at the depth 0 m is from 1 N to -1 N");
  faulty({{0, 1e-3}, {{{}, {0, {-1, 4000}, {1}}, level}}}, "at the depth 0.001 m is from 3 N to 1 N");
  faulty({{0, 2e-3}, {{{}, {0, {-1, 4000, -2e6}, {0}}, level}}}, "at the depth 0.001 m is from 1 N to 0 N");
  faulty({{0, 1e-3}, {{{}, {0, {1}, {2}}, level}}}, "at the depth 0 m is 1 N; it must be 0 N or less");  // pulls in
  faulty({{0, 2e-3}, {{{}, hump, level}}}, "at the depth 0.001 m is 0.9 N; it must be 0 N or less");
  faulty({{0, 1e-3}, {{{}, good, {0, {nan}, {1}}}}}, "both must be finite");
  faulty({{0, 1e-3}, {{{}, {0, {-1}, {1, nan}}, level}}}, "both must be finite");
}
