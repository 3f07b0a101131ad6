// Several steps of the model in a tick.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../support/paper_scene.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr double sub_T = 1 / 1600.0;
const Vector3d sub_down(0, -1, 0);

Scene sub_stepped(double n, double thickness, double low_pass = 0) {
  Scene scene = paper_scene(thickness);
  scene.servo.sub_steps = n;
  scene.servo.low_pass = low_pass;
  return scene;
}

/// When the force is half-way down from its peak at the pop, s, from the entry on. The needle moves at 20 mm/s.
template <typename Force>
double time_of_pop(double period, Force&& force_at) {
  double peak = 0, before = 0, plateau = 0.41024;
  for (int k = 0;; ++k) {
    const double depth = -0.2e-3 + 20e-3 * k * period, force = force_at(depth);
    peak = std::max(peak, force);
    const double middle = (peak + plateau) / 2;
    if (depth > 5e-3 && force < middle && before >= middle)
      return (k - (middle - force) / (before - force)) * period - 0.01;
    if (depth > 9e-3) return 1;  // no pop
    before = force;
  }
}

}  // namespace

TEST_CASE("on a straight motion, sub-steps give the forces of ticks that are as many times shorter") {
  for (const int n : {2, 5, 16}) {
    Insertion insertion = build_insertion(sub_stepped(n, 1e-3));
    Proxy1d fine(ThickLaw(paper_needle, paper_membrane(1e-3)), Coupling{400, 1}, sub_T / n);
    double depth = -1e-3;
    for (int k = 0; k < 4000; ++k) {
      const double next = depth + (k < 2500 ? 5e-3 : -5e-3) * sub_T;
      if (k > 0)
        for (int i = 1; i < n; ++i) fine.step(depth + (next - depth) * i / n);
      depth = next;
      REQUIRE(insertion.step(depth * sub_down, sub_down).y() == doctest::Approx(-fine.step(depth)).epsilon(1e-7));
    }
  }
}

TEST_CASE("8 sub-steps find the time of a pop within 0.3 ms, one step does not") {
  Proxy1d reference(ThickLaw(paper_needle, paper_membrane(1e-4)), Coupling{400, 1}, sub_T / 1000);
  const double right = time_of_pop(sub_T / 1000, [&](double depth) { return -reference.step(depth); });
  for (const auto& [n, least, most] : {std::array{8.0, 0.0, 0.3e-3}, std::array{1.0, 0.3e-3, 2e-3}}) {
    Insertion insertion = build_insertion(sub_stepped(n, 1e-4));
    const double found =
        time_of_pop(sub_T, [&](double depth) { return insertion.step(depth * sub_down, sub_down).y(); });
    CHECK(std::abs(found - right) >= least);
    CHECK(std::abs(found - right) <= most);
  }
}

TEST_CASE("a run with sub-steps goes on from a kept state, and another number of them does not jump") {
  const Scene scene = sub_stepped(4, 1e-3, 300);
  Insertion one = build_insertion(scene), other = build_insertion(scene);
  double depth = -1e-3;
  const auto tick = [&](Insertion& insertion) { return insertion.step(depth * sub_down, sub_down); };
  for (; depth < 5e-3; depth += 5e-3 * sub_T) tick(one);
  REQUIRE(load_state(other, save_state(one)));
  for (; depth < 6e-3; depth += 5e-3 * sub_T) REQUIRE(tick(one) == tick(other));

  Insertion plain = build_insertion(sub_stepped(1, 1e-3, 300));
  CHECK(!load_state(plain, save_state(one)));
  const double before = one.force().y();
  plain.resume(one);
  depth += 5e-3 * sub_T;
  CHECK(tick(plain).y() == doctest::Approx(before).epsilon(0.02));
  Insertion four = build_insertion(scene);
  four.resume(plain);
  depth += 5e-3 * sub_T;
  CHECK(tick(four).y() == doctest::Approx(before).epsilon(0.02));
}
