// The forces of K06 equal the recorded forces, bit for bit: both solvers, both scalars, one and three dimensions.
#include <doctest/doctest.h>

#include <string>

#include "../support/cases.hpp"
#include "golden_hashes.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {
constexpr GoldenHashes recorded[golden_count] = {
#include "golden_forces.inc"
};
}  // namespace

TEST_CASE("the forces of 200 random scenes equal the recorded forces, bit for bit") {
  const std::size_t count = static_cast<std::size_t>(at_most(static_cast<int>(golden_count)));
  for (std::size_t k = 0; k < count; ++k) {
    const GoldenHashes now = golden_hashes(k);
    for (std::size_t i = 0; i < now.size(); ++i) {
      INFO("scene " << k << ", " << std::string(golden_names[i]));
      CHECK(now[i] == recorded[k][i]);
    }
  }
}

TEST_CASE("the golden scenes reach each phase with both solvers") {
  for (Solver solver : {Solver::paper, Solver::exact}) {
    std::array<int, 5> ticks{};
    for (std::size_t k = 0; k < 40; ++k) {
      GoldenCase c = golden_case(k);
      c.scene.servo.solver = solver;
      auto insertion = build_insertion(c.scene);
      for (const Vector3d& p : c.positions) {
        insertion.step(p, c.axis);
        for (const auto& proxy : *insertion.k06()) ++ticks[static_cast<std::size_t>(proxy.phase())];
      }
    }
    for (int n : ticks) CHECK(n > 100);
  }
}
