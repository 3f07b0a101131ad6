// A saved state continues with the same bits. Invalid bytes change nothing.
#include "punctura/state/archive.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <initializer_list>
#include <limits>

#include "../support/cut_law.hpp"
#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/proxy/mixed_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

Scene two_membranes() {
  Scene scene = paper_scene();
  scene.membranes.push_back({"second", paper_membrane(0.5e-3), {0, -3e-3, 0}, {0.3, -1, 0}});
  return scene;
}

/// A law that remembers the deepest point. Its friction decreases with this depth.
struct Worn {
  double deepest = 0;
  static void archive(auto& self, auto& state) {
    state.fields(self.deepest);
    state.require(self.deepest >= 0);
  }
};
struct WornLaw : ThickLaw {
  using Memory = Worn;
  using ThickLaw::pieces;
  using ThickLaw::ThickLaw;
  Pieces pieces(double cos_beta, const Memory& memory) const noexcept {
    Pieces all = ThickLaw::pieces(cos_beta);
    for (auto& piece : all.pieces)
      piece.lower = {piece.lower.c0 / (1 + memory.deepest), piece.lower.c1, piece.lower.c2};
    return all;
  }
  bool advance(Memory& memory, double depth) const noexcept {
    return depth > memory.deepest && (memory.deepest = depth, true);
  }
};

}  // namespace

TEST_CASE("a saved insertion continues in another object with the same bits") {
  Noise noise(7);
  for (const Direction direction : {Direction::stylus, Direction::motion})
    for (const Conditioning conditioning : {Conditioning::low_pass, Conditioning::line_fit})
      for (const Solver solver : {Solver::paper, Solver::exact}) {
        Scene scene = two_membranes();
        scene.direction = direction;
        scene.servo.conditioning = conditioning;
        scene.servo.solver = solver;
        const auto depths = random_motion(noise, 4000, 8e-3, T);
        const auto at = [&](std::size_t k) { return Vector3d(0, -depths[k], 0); };
        const Vector3d axis(0, -1, 0);
        for (const std::size_t kept_at :
             {std::size_t{0}, std::size_t{1}, std::size_t{17}, std::size_t{1500}, std::size_t{2500}}) {
          Insertion first = build_insertion(scene), other = build_insertion(scene);
          for (std::size_t k = 0; k < kept_at; ++k) first.step(at(k), axis);
          for (std::size_t k = 0; k < 50; ++k) other.step({1e-3, -1e-3 * static_cast<double>(k), 0}, axis);
          const auto kept = save_state(first);
          REQUIRE(load_state(other, kept));
          CHECK(save_state(other) == kept);
          CHECK(other.force() == first.force());
          CHECK(other.tip() == first.tip());
          for (std::size_t k = kept_at; k < depths.size(); ++k) {
            REQUIRE(other.step(at(k), axis) == first.step(at(k), axis));
            REQUIRE(other.tick(1).depth == first.tick(1).depth);
          }
        }
      }
}

TEST_CASE("a loaded or copied proxy has the whole last tick, and continues with the same bits") {
  Noise noise(93);
  const auto motion = random_motion(noise, 2000, 10e-3, T);
  for (const Solver solver : {Solver::paper, Solver::exact}) {
    const ThickLaw law(paper_needle, paper_membrane(1e-3));
    Proxy1d line(law, Coupling{400, 1}, T, solver), loaded_line = line;
    Proxy3d space(law, Vector3d(), down, Coupling{400, 1}, T, solver), loaded_space = space;
    for (const double p : motion) {
      const auto copied_line = line;
      const auto copied_space = space;
      REQUIRE(load_state(loaded_line, save_state(line)));
      REQUIRE(load_state(loaded_space, save_state(space)));
      for (const auto& other : {loaded_line.tick(), copied_line.tick()}) {
        REQUIRE(other.force == line.force());
        REQUIRE(other.proxy == line.position());
        REQUIRE(other.depth == line.depth());
        REQUIRE(other.band.lower == line.tick().band.lower);
        REQUIRE(other.band.upper == line.tick().band.upper);
      }
      for (const auto& other : {loaded_space.tick(), copied_space.tick()}) {
        REQUIRE(other.force == space.force());
        REQUIRE(other.axial_force == space.axial_force());
        REQUIRE(other.depth == space.depth());
        REQUIRE(other.band.lower == space.band().lower);
        REQUIRE(other.band.upper == space.band().upper);
      }
      REQUIRE(loaded_line.step(p) == line.step(p));
      REQUIRE(loaded_space.step(p * down, down) == space.step(p * down, down));
    }
  }
}

TEST_CASE("the memory of a custom law and its pieces are saved") {
  Noise noise(8);
  const auto depths = random_motion(noise, 2000, 8e-3, T);
  const WornLaw law(paper_needle, paper_membrane(1e-3));
  Proxy3d first(law, Vector3d(0, 0, 0), Vector3d(0, -1, 0), Coupling{400, 1}, T);
  Proxy1d line(law, Coupling{400, 1}, T);
  auto other = first;
  auto other_line = line;
  for (std::size_t k = 0; k < 1000; ++k) {
    first.step({0, -depths[k], 0}, {0, -1, 0});
    line.step(depths[k]);
  }
  REQUIRE(first.state().law.deepest > 1e-3);
  REQUIRE(load_state(other, save_state(first)));
  REQUIRE(load_state(other_line, save_state(line)));
  CHECK(other_line.force() == line.force());
  CHECK(other_line.depth() == line.depth());
  for (std::size_t k = 1000; k < 2000; ++k) {
    REQUIRE(other.step({0, -depths[k], 0}, {0, -1, 0}) == first.step({0, -depths[k], 0}, {0, -1, 0}));
    REQUIRE(other_line.step(depths[k]) == line.step(depths[k]));
  }
}

TEST_CASE("the memory of each law in a MixedLaw scene is saved") {
  using Mixed = MixedLaw<ThickLaw, WornLaw>;
  Noise noise(9);
  const auto depths = random_motion(noise, 2000, 8e-3, T);
  for (const bool worn : {false, true}) {
    const Mixed law =
        worn ? Mixed(WornLaw(paper_needle, paper_membrane(1e-3))) : Mixed(ThickLaw(paper_needle, paper_membrane(1e-3)));
    Proxy3d first(law, Vector3d(0, 0, 0), Vector3d(0, -1, 0), Coupling{400, 1}, T);
    auto other = first;
    for (std::size_t k = 0; k < 1000; ++k) first.step({0, -depths[k], 0}, {0, -1, 0});
    REQUIRE(load_state(other, save_state(first)));
    CHECK(other.state().law.index() == (worn ? 1 : 0));
    for (std::size_t k = 1000; k < 2000; ++k)
      REQUIRE(other.step({0, -depths[k], 0}, {0, -1, 0}) == first.step({0, -depths[k], 0}, {0, -1, 0}));
  }
}

namespace {
/// A number that the untouched pieces do not show.
struct SlowLaw : CutLaw {
  double time_constant;
  void describe(auto& parameters) const { parameters.fields(time_constant); }
};
}  // namespace

TEST_CASE("a state belongs to the numbers that a custom law describes, alone and in a MixedLaw") {
  const auto own = [](double time_constant) {
    return Proxy3d(SlowLaw{{}, time_constant}, {}, {0, -1, 0}, Coupling{400, 1}, T);
  };
  const auto mixed = [](double time_constant) {
    using Mixed = MixedLaw<ThickLaw, SlowLaw>;
    return Proxy3d(Mixed(SlowLaw{{}, time_constant}), {}, {0, -1, 0}, Coupling{400, 1}, T);
  };
  const auto line = [](double time_constant) { return Proxy1d(SlowLaw{{}, time_constant}, Coupling{400, 1}, T); };
  const auto check = [](const auto& made) {
    auto same = made(1.0), other = made(2.0);
    CHECK(load_state(same, save_state(made(1.0))));
    CHECK(!load_state(other, save_state(made(1.0))));
  };
  check(own);
  check(mixed);
  check(line);
}

TEST_CASE("after a reset the state equals that of a new object") {
  Scene scene = two_membranes();
  scene.direction = Direction::motion;
  scene.servo.conditioning = Conditioning::line_fit;
  Insertion used = build_insertion(scene);
  for (int k = 0; k < 300; ++k) used.step({0, 1e-3 - 1e-4 * k, 0}, {0, -1, 0});
  used.reset();
  CHECK(save_state(used) == save_state(build_insertion(scene)));
}

TEST_CASE("load_state() refuses bytes of another object or version and damaged bytes, without a change") {
  const Scene scene = two_membranes();
  Insertion insertion = build_insertion(scene);
  for (int k = 0; k < 100; ++k) insertion.step({0, 1e-3 - 1e-4 * k, 0}, {0, -1, 0});
  const auto kept = save_state(insertion);
  const auto refused = [&](const std::vector<std::byte>& bytes) {
    const bool loaded = load_state(insertion, bytes);
    return !loaded && save_state(insertion) == kept;
  };
  CHECK(refused({}));
  CHECK(!refused(kept));
  for (const auto& change : std::initializer_list<void (*)(Scene&)>{
           [](Scene& s) { s.membranes[1].membrane.stiffness *= 1.001; },
           [](Scene& s) { s.membranes[0].point[1] = 1e-3; }, [](Scene& s) { s.coupling.damping = 2; },
           [](Scene& s) { s.servo.rate = 1000; }, [](Scene& s) { s.servo.low_pass = 0; },
           [](Scene& s) { s.servo.solver = Solver::paper; }, [](Scene& s) { s.needle.diameter = 2e-3; },
           [](Scene& s) { s.membranes.pop_back(); }}) {
    Scene other = scene;
    change(other);
    CHECK(refused(save_state(build_insertion(other))));
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    auto damaged = kept;
    damaged[i] ^= std::byte{1};
    REQUIRE(refused(damaged));
  }
  auto other_length = kept;
  other_length.pop_back();
  CHECK(refused(other_length));
  other_length.resize(kept.size() + 1);
  CHECK(refused(other_length));
}

/// Forged bytes: the digest matches the changed bytes.
std::vector<std::byte> forged(std::vector<std::byte> bytes) {
  StateHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  header.state = detail::digest(std::span(bytes).subspan(sizeof header));
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

TEST_CASE("forged bytes cause no invalid memory access, and impossible phases, directions and positions are refused") {
  Scene scene = two_membranes();
  scene.direction = Direction::motion;
  scene.servo.conditioning = Conditioning::line_fit;
  Insertion insertion = build_insertion(scene);
  for (int k = 0; k < 100; ++k) insertion.step({0, 1e-3 - 1e-4 * k, 0}, {0, -1, 0});
  const auto kept = save_state(insertion);
  int taken = 0;
  for (std::size_t i = sizeof(StateHeader); i < kept.size(); ++i) {  // under the address sanitizer
    auto changed = kept;
    changed[i] ^= std::byte{0xff};
    Insertion other = build_insertion(scene);
    if (!load_state(other, forged(changed))) continue;
    ++taken;
    for (int k = 0; k < 5; ++k) other.step({0, -5e-3, 0}, {0, -1, 0});
  }
  CHECK(taken > 100);

  const Proxy3d<ThickLaw>& inside_one = (*insertion.k06())[0];
  REQUIRE(inside(inside_one.phase()));
  const auto with = [&](std::size_t number,
                        double value) {  // the numbers behind started and phase: p, e, f, b, cos_beta
    auto changed = save_state(inside_one);
    std::memcpy(changed.data() + sizeof(StateHeader) + (2 + number) * sizeof value, &value, sizeof value);
    Proxy3d<ThickLaw> other = inside_one;
    return load_state(other, forged(changed));
  };
  CHECK(with(0, inside_one.state().p.x()));
  CHECK(!with(0, 1e7));
  CHECK(!with(0, std::numeric_limits<double>::quiet_NaN()));
  CHECK(!with(10, -1e3));
  CHECK(!with(12, 0));
  CHECK(!with(12, 2));
}

// If this fails, the fields or their order have changed. Increase StateHeader::format, then enter the new numbers.
TEST_CASE("the bytes of a state match its format number") {
  Scene scene = two_membranes();
  scene.direction = Direction::motion;
  scene.servo.conditioning = Conditioning::line_fit;
  Insertion insertion = build_insertion(scene);
  Proxy1d line(ThickLaw(paper_needle, paper_membrane(1e-3)), Coupling{400, 1}, T);
  for (int k = 0; k < 100; ++k) {
    insertion.step({0, 1e-3 - 1e-4 * k, 0}, {0, -1, 0});
    line.step(1e-4 * k);
  }
  const auto digest_of = [](const std::vector<std::byte>& bytes) {
    StateHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    return header.state;
  };
  CHECK(StateHeader{}.format == 6);
  CHECK(digest_of(save_state(insertion)) == 17756143676564190799u);
  CHECK(digest_of(save_state(line)) == 13125173204460860576u);
}

TEST_CASE("a position beyond 1000 km gives NaN and changes nothing") {
  Insertion insertion = build_insertion(two_membranes());
  Proxy1d line(ThickLaw(paper_needle, paper_membrane(1e-3)), Coupling{400, 1}, T);
  for (int k = 0; k < 100; ++k) {
    insertion.step({0, 1e-3 - 1e-4 * k, 0}, {0, -1, 0});
    line.step(1e-4 * k);
  }
  Proxy3d space = (*insertion.k06())[0];
  const auto kept = save_state(insertion), kept_line = save_state(line), kept_space = save_state(space);
  for (const double far : {1.1e6, -1.7e308, std::numeric_limits<double>::infinity()}) {
    CHECK(std::isnan(insertion.step({far, 0, 0}, {0, -1, 0}).x()));
    CHECK(std::isnan(space.step({0, 0, far}, {0, -1, 0}).x()));
    CHECK(std::isnan(line.step(far)));
  }
  CHECK(save_state(insertion) == kept);
  CHECK(save_state(line) == kept_line);
  CHECK(save_state(space) == kept_space);
  CHECK(insertion.step({1e6, -1e6, 1e6}, {0, -1, 0}).allFinite());
}
