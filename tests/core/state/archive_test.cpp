// A state that was kept goes on to the same bits; bytes that are no state change nothing.
#include "punctura/state/archive.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double T = 1 / 1600.0;

Scene two_membranes() {
  Scene scene = paper_scene();
  scene.membranes.push_back({"second", paper_membrane(0.5e-3), {0, -3e-3, 0}, {0.3, -1, 0}});
  return scene;
}

/// A law that remembers the deepest point and grips less in front of it.
struct Healing {
  double deepest = 0;
};
struct WornLaw : ThickLaw {
  using Memory = Healing;
  using ThickLaw::pieces;
  using ThickLaw::ThickLaw;
  Pieces pieces(double cos_beta, const Memory& memory) const noexcept {
    Pieces all = ThickLaw::pieces(cos_beta);
    for (auto& piece : all.pieces)
      piece.lower = {piece.lower.c0 / (1 + memory.deepest), piece.lower.c1, piece.lower.c2};
    return all;
  }
  Pieces pieces(const Memory& memory) const noexcept { return pieces(1, memory); }
  bool advance(Memory& memory, double depth) const noexcept {
    return depth > memory.deepest && (memory.deepest = depth, true);
  }
};

}  // namespace

TEST_CASE("an insertion that was kept goes on to the same bits in another one, wherever it was kept") {
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
            REQUIRE(other.proxies()[1].depth() == first.proxies()[1].depth());
          }
        }
      }
}

TEST_CASE("what a law of one's own remembers is kept, and its pieces with it") {
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

TEST_CASE("bytes that are no state of this object are refused, and leave it as it was") {
  Insertion insertion = build_insertion(two_membranes());
  for (int k = 0; k < 100; ++k) insertion.step({0, -1e-4 * k, 0}, {0, -1, 0});
  const auto kept = save_state(insertion);
  const auto refused = [&](std::vector<std::byte> bytes) {
    const bool loaded = load_state(insertion, bytes);
    return !loaded && save_state(insertion) == kept;
  };
  auto changed = kept;
  changed.pop_back();
  CHECK(refused(changed));
  changed.resize(kept.size() + 1);
  CHECK(refused(changed));
  CHECK(refused({}));
  CHECK(refused(save_state(build_insertion(paper_scene()))));

  changed = kept;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(changed.data() + changed.size() - sizeof nan, &nan, sizeof nan);
  CHECK(refused(changed));
  changed = kept;
  changed[sizeof state_format] = std::byte{7};  // a flag
  CHECK(refused(changed));
  for (const std::byte format : {std::byte{0}, std::byte{2}}) {  // of another version
    changed = kept;
    changed[0] = format;
    CHECK(refused(changed));
  }
  CHECK(!refused(kept));
}

TEST_CASE("a state with an index beyond its memory is refused, whichever byte is changed") {
  Scene scene = two_membranes();
  scene.direction = Direction::motion;
  scene.servo.conditioning = Conditioning::line_fit;
  Insertion insertion = build_insertion(scene);
  for (int k = 0; k < 100; ++k) insertion.step({0, -1e-4 * k, 0}, {0, -1, 0});
  const auto kept = save_state(insertion);
  for (std::size_t i = 0; i < kept.size(); ++i) {  // under the address sanitizer
    auto changed = kept;
    changed[i] ^= std::byte{0xff};
    Insertion other = build_insertion(scene);
    if (load_state(other, changed)) other.step({0, -5e-3, 0}, {0, -1, 0});
  }
}
