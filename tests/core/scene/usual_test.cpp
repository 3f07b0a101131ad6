#include "punctura/scene/usual.hpp"

#include <doctest/doctest.h>

#include "../support/paper_scene.hpp"

using namespace punctura;
using namespace punctura::test;

TEST_CASE("a usual scene has no unusual number") { CHECK(unusual(paper_scene()).empty()); }

TEST_CASE("a number that is off by a factor of 1,000 is reported with what to write") {
  auto scene = paper_scene();
  scene.needle.diameter = 1.08;
  scene.membranes[0].membrane.stiffness = 0.57;
  const auto lines = unusual(scene);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == "needle.diameter = 1.08 m is unusual. If you meant 1.08 mm, write 0.00108");
  CHECK(lines[1] == "membrane[0].stiffness = 0.57 N/m is unusual. If you meant 0.57 N/mm, write 570");
}

TEST_CASE("what to write is in the unit of the number") {
  CHECK(unusual("membrane[3].stiffness", 570, 1e3) == "If you meant 570 N/m, write 0.57");
  CHECK(unusual("needle.diameter", 1080, 1e-3) == "If you meant 1080 um, write 1.08");
  CHECK(unusual("coupling.stiffness", 4e6) == "If you meant a number 1000 times smaller, write 4000");
  CHECK(unusual("needle.diameter", 1.08, 1e-3).empty());
  CHECK(unusual("syringe.bore", 0.015, 1e-3) == "If you meant 0.015 m, write 15");
  CHECK(unusual("syringe.liquid", 3) == "If you meant 3 mL, write 3e-06");
  CHECK(unusual("syringe.compliance", 1, 1e-9) == "If you meant a number 1000 times smaller, write 0.001");
  CHECK(unusual("syringe.resistance", 2.5) == "If you meant 2.5 kPa s/mL, write 2.5e+09");
  CHECK(unusual("syringe.air", 0).empty());
}

TEST_CASE("a number that no factor of 1,000 makes usual is left alone") {
  CHECK(unusual("needle.diameter", 1e9).empty());
  CHECK(unusual("membrane[0].thickness", 0).empty());
  CHECK(unusual("membrane[0].friction", 1e6).empty());
  CHECK(unusual("a path", std::nan("")).empty());
}
